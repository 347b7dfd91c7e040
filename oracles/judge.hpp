/// The judge: turns an answer and the oracle's word into a finding with numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "impl/catalogue/case.hpp"
#include "impl/subject/standard.hpp"
#include "oracles/exact/enclosure.hpp"

namespace nearmiss {

enum class Verdict {
  agrees,             ///< no difference above one ulp that the oracle can show
  not_proved,         ///< differs; not proved to differ by more than was promised
  violates_contract,  ///< proved: differs by more than was promised
  exceeds_measure,    ///< proved: differs by more than the measure, while nothing was promised
  out_of_domain,      ///< the promise does not cover this input
  cannot_answer,      ///< the subject has no answer to this case; never a miss
  broke,              ///< exception, abort, crash, time or memory limit
  not_asked,          ///< the case is outside of what the subject requires
};
inline constexpr int verdict_count = 8;

/// In which way a member of an answer differs. The two directions of a wrong decision are never added together.
enum class Disagreement {
  none,
  false_hit,   ///< yes where the truth is no: a phantom collision
  false_miss,  ///< no where the truth is yes: a missed collision
  wrong_time,
  negative_time,  ///< a time of contact before the start
  wrong_place,
  wrong_normal,
  wrong_depth,
  wrong_direction,
  wrong_weight,       ///< barycentric weights, cosines
  wrong_flag,         ///< a yes or no beside the decision
  wrong_index,        ///< an edge, an axis
  wrong_combination,  ///< each member may be right by itself; no right answer has them together
  off_surface,        ///< a wrong place that is not even on the surface that it is to lie on
  not_finite,         ///< NaN or infinity in a given number
  not_unit,           ///< a normal whose length is not 1
};
inline constexpr int disagreement_count = int(Disagreement::not_unit) + 1;

std::string_view name_of(Verdict v);
std::string_view name_of(Disagreement d);

/// What of a contract an answer breaks; the last two are broken whatever is promised.
enum class Clause { none, exact_decisions, backward, forward, unit, finite_numbers, no_negative_time };

/// A proved lower bound on the backward error: no input within `above` * epsilon has an exact answer
/// that the given one matches. On the ladder 0, 1, 2, 4 ... 2^50.
struct Backward {
  double above = 0;
};

/// What is proved against one member of an answer, seen by itself.
struct MemberFinding {
  static constexpr int decision = -1;

  int member = decision;  ///< index in the query's layout; a normal may have two findings: its direction, its length
  Disagreement disagreement = Disagreement::none;
  /// No input within `above` * epsilon has an exact answer with the given yes or no and with this member. Empty: the
  /// disagreement is not one of distance (a number that is not finite, a length).
  std::optional<Backward> backward;
  /// At least so far from the nearest exact one of the case itself. Zero, and no number, where the decision is wrong.
  double forward_ulps = 0;
  double forward_absolute = 0;   ///< the same distance in the number's own unit
  int worst = -1;                ///< index of the number that is so far off, among the query's outputs
  Clause broken = Clause::none;  ///< the clause of the contract that the member breaks
  std::string clause;            ///< the same for people

  bool breaks() const { return broken != Clause::none; }
};

/// The judge's word on one answer.
struct Finding {
  Verdict verdict = Verdict::agrees;
  Disagreement disagreement = Disagreement::none;  ///< of the headline
  Clause broken = Clause::none;                    ///< for a violation
  /// The same for people; the reason, where the subject broke, cannot answer or is not asked.
  std::string clause;
  bool late = false;  ///< broke: a time limit was reached

  bool truth_yes = false;              ///< the exact decision
  Stage decided_by = Stage::interval;  ///< who decided it
  std::optional<Backward> backward;    ///< of the whole answer; empty: nothing is proved against it
  double forward_ulps = 0;             ///< of the whole answer: so far at least from the nearest exact one
  double forward_absolute = 0;         ///< the same distance in the worst number's own unit
  int worst = -1;                      ///< index of that number among the query's outputs
  double unit_error = 0;               ///< |normal| - 1, in units of epsilon; 0 where none is given

  std::vector<MemberFinding> members;  ///< every member that differs, whatever the others do; empty for a combination
  int headline = -1;                   ///< the one of them that breaks or differs most; -1: none

  const MemberFinding* headline_member() const { return headline < 0 ? nullptr : &members[std::size_t(headline)]; }
  /// Proved to differ by more than the contract, or the measure, allows.
  bool is_proved() const { return verdict == Verdict::violates_contract || verdict == Verdict::exceeds_measure; }
  /// Some member disagrees in that way and, for a violation, breaks the contract by it.
  bool has(Disagreement d) const;
};

/// How much to find out beyond the verdict.
enum class Detail {
  verdict,  ///< as little work as the verdict takes; numbers only where they came for free
  forward,  ///< the forward error too, to a tenth of an ulp
  full,     ///< exact forward error and the backward bound, for a report
};

/// Judges `answer` to a valid case by what it is held to. A case outside of what the standard requires is not_asked,
/// whatever the answer. Thread-safe. The caller's modes of floating-point arithmetic, whatever they are, change
/// nothing, here and wherever the oracle is asked.
Finding judge(const Case& question, const Answer& answer, const Standard& standard, Detail detail);

/// The exact decision alone, with as little work as it takes. Thread-safe.
bool exact_decision(const Case& question);

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
