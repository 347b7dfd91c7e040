/// The judge: turns an answer and the oracle's word into a finding with numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <collide/contract.hpp>

#include "oracles/case.hpp"

namespace nearmiss {

enum class Verdict {
  agrees,             ///< no difference above one ulp that the oracle can show
  within_contract,    ///< differs, by no more than was promised
  violates_contract,  ///< proved: differs by more than was promised
  out_of_domain,      ///< the promise does not cover this input
  cannot_answer,      ///< the subject has no answer to this case; never a miss
  broke,              ///< exception, abort, crash, time or memory limit
};
inline constexpr int verdict_count = 6;

/// In which way an answer differs. The two directions of a wrong decision are never added together.
enum class Disagreement {
  none,
  false_hit,   ///< yes where the truth is no: a phantom collision
  false_miss,  ///< no where the truth is yes: a missed collision
  wrong_time,
  wrong_place,
  wrong_normal,
  wrong_depth,
  wrong_direction,
  wrong_weight,  ///< barycentric weights, cosines
  wrong_flag,    ///< a yes or no beside the decision
  wrong_index,   ///< an edge, an axis
  off_surface,   ///< a wrong place that is not even on the surface that it is to lie on
  not_finite,    ///< NaN or infinity in a given number
  not_unit,      ///< a normal whose length is not 1
};

std::string_view name_of(Verdict v);
std::string_view name_of(Disagreement d);

/// A proved lower bound on the backward error: no input within `above` * epsilon has an exact answer
/// that the given one matches. On the ladder 0, 1, 2, 4 ... 2^50.
struct Backward {
  double above = 0;
};

/// The judge's word on one answer.
struct Finding {
  Verdict verdict = Verdict::agrees;
  Disagreement disagreement = Disagreement::none;
  std::string clause;  ///< of the contract, for a violation; the reason, where the subject broke

  bool truth_yes = false;                 ///< the exact decision
  Stage decided_by = Stage::interval;     ///< who decided it
  std::optional<Backward> backward;       ///< empty: nothing is proved against the answer
  double forward_ulps = 0;                ///< of the worst number: at least this many ulps from an exact answer
  double forward_absolute = 0;            ///< the same distance in the number's own unit
  int worst = -1;                         ///< index of that number among the query's outputs
  double unit_error = 0;            ///< |normal| - 1, in units of epsilon; 0 where none is given
};

/// How much to find out beyond the verdict.
enum class Detail {
  verdict,  ///< as little work as the verdict takes; numbers only where they came for free
  forward,  ///< the forward error too, to a tenth of an ulp
  full,     ///< exact forward error and the backward bound, for a report
};

/// Judges `answer`, which `contract` promises something about, to a valid case. Thread-safe.
Finding judge(const Case& question, const Answer& answer, const collide::Contract& contract, Detail detail);

/// The exact answers to a case, for people: all of them, and how far the nearest flip is.
struct Truth {
  bool yes = false;
  Stage decided_by = Stage::interval;
  std::vector<Alternative> alternatives;
  /// The decision is the same for every input within this many epsilon (of the case's scalar).
  /// Proved, on the ladder; negative: not even the interval at the input itself shows it.
  double margin_at_least = -1;
};
Truth truth_of(const Case& question);

/// The ladder's k-th rung: 0, 1, 2, 4 ... 2^50.
double rung(int k);
inline constexpr int rungs = 52;

/// How far each number of the input moves for a backward error of k: k * epsilon * the largest
/// magnitude in its group, rounded up. Flags and indices do not move.
std::vector<double> widening(const Query& query, std::span<const double> values, Scalar scalar, double k);

}  // namespace nearmiss
