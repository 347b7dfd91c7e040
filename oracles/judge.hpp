/// The judge: compares an answer with the oracle's and returns a finding with numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "impl/catalogue/case.hpp"
#include "impl/subject/standard.hpp"
#include "oracles/exact/enclosure.hpp"
#include "oracles/exact_decision.hpp"
#include "oracles/scene_limits.hpp"

namespace nearmiss {

enum class Verdict {
  agrees,             ///< the oracle proves no difference above one ulp
  not_proved,         ///< differs, but not provably by more than the contract allows
  violates_contract,  ///< proved: differs by more than the contract allows
  exceeds_measure,    ///< proved, without a contract: differs by more than the measure, or than a scene tolerates
  out_of_domain,      ///< the contract does not cover this input
  cannot_answer,      ///< the subject has no answer to this case; never a miss
  broke,              ///< exception, abort, crash, time or memory limit
  not_asked,          ///< the case breaks a precondition of the subject
};
inline constexpr int verdict_count = 8;

/// How a member of an answer differs. The two directions of a wrong decision are never added together.
enum class Disagreement {
  none,
  false_hit,   ///< yes where the truth is no: a phantom collision
  false_miss,  ///< no where the truth is yes: a missed collision
  wrong_time,
  negative_time,  ///< a time of contact before the start
  wrong_place,
  wrong_normal,
  wrong_depth,
  wrong_distance,
  wrong_size,  ///< a half extent
  wrong_direction,
  wrong_weight,       ///< barycentric weights, cosines
  wrong_flag,         ///< a flag other than the decision
  wrong_index,        ///< of an edge or an axis
  wrong_combination,  ///< each member may be right alone, but no right answer has them together
  off_surface,        ///< a wrong place that does not even lie on its surface
  not_finite,         ///< NaN or infinity in a given number
  not_unit,           ///< a normal whose length is not 1
};
inline constexpr int disagreement_count = int(Disagreement::not_unit) + 1;

std::string_view name_of(Verdict v);
std::string_view name_of(Disagreement d);

/// The clause of a contract that an answer breaks, or what a scene requires of it. The last two clauses always hold.
enum class Clause { none, exact_decisions, backward, forward, unit, scene, finite_numbers, no_negative_time };

/// A proved lower bound on the backward error: no input within `above` * epsilon has an exact answer that matches the
/// given one. A rung of the ladder 0, 1, 2, 4 ... 2^50.
struct Backward {
  double above = 0;
};

/// What is proved against one member of an answer, judged alone.
struct MemberFinding {
  static constexpr int decision = -1;

  int member = decision;  ///< index in the query's layout; a normal may have two findings: direction and length
  Disagreement disagreement = Disagreement::none;
  /// No input within `above` * epsilon has an exact answer with the given decision and with this member. Empty where
  /// the disagreement is not a distance (a number that is not finite, a length).
  std::optional<Backward> backward;
  /// Lower bound of the distance to the nearest exact answer of the case itself, in ulps. 0 where the decision is
  /// wrong.
  double forward_ulps = 0;
  double forward_absolute = 0;   ///< the same distance in the number's own unit
  int worst = -1;                ///< index among the query's outputs of the number with this distance
  Clause broken = Clause::none;  ///< the clause of the contract that the member breaks
  std::string clause;            ///< the broken clause in words
  double times_tolerated = 0;    ///< the proved error over what the scene tolerates; 0 for any other clause

  bool breaks() const { return broken != Clause::none; }
};

/// The judge's verdict on one answer, with its proof.
struct Finding {
  Verdict verdict = Verdict::agrees;
  Disagreement disagreement = Disagreement::none;  ///< of the headline
  Clause broken = Clause::none;                    ///< for a violation
  /// The clause in words; or the reason why the subject broke, cannot answer or is not asked.
  std::string clause;
  BreakCause cause = BreakCause::other;  ///< for a subject that broke

  bool truth_yes = false;              ///< the exact decision
  Stage decided_by = Stage::interval;  ///< the stage that decided it
  std::optional<Backward> backward;    ///< of the whole answer; empty: no difference is proved
  /// The preconditions that an input on the rung after the bound may break, where this ends the search: the bounds of
  /// the answer and of its members could be higher, but a higher rung proves nothing. Otherwise empty.
  Preconditions ended_by{};
  double forward_ulps = 0;          ///< of the whole answer: lower bound of the distance to the nearest exact answer
  double forward_absolute = 0;      ///< the same distance in the worst number's own unit
  int worst = -1;                   ///< index of the worst number among the query's outputs
  double unit_error = 0;            ///< |normal| - 1, in units of epsilon; 0 where the answer has no normal
  std::uint64_t branches = 0;       ///< the branches of the oracle that reported right answers (Enclosure::branches)
  std::uint32_t right_answers = 0;  ///< how many right answers the oracle reported; more than one: a tie

  /// True where a judgement with Detail::full has the same verdict, truth and backward bounds, and the same members
  /// break the contract, with the same headline. Its forward error is at most `forward_at_most` ulps.
  bool settled = false;
  double forward_at_most = 0;

  std::vector<MemberFinding> members;  ///< every member that differs; empty for a wrong combination
  int headline = -1;                   ///< index in `members` of the one that breaks or differs most; -1: none

  const MemberFinding* headline_member() const { return headline < 0 ? nullptr : &members[std::size_t(headline)]; }
  /// The answer provably differs by more than the contract, or the measure, allows.
  bool is_proved() const { return verdict == Verdict::violates_contract || verdict == Verdict::exceeds_measure; }
  /// Some member has this disagreement and, for a violation, breaks the contract by it.
  bool has(Disagreement d) const;
};

/// How much to compute beyond the verdict.
enum class Detail {
  verdict,  ///< only what the verdict needs; numbers only if they need no extra work
  forward,  ///< also the forward error, to a tenth of an ulp
  full,     ///< also the exact forward error and the backward bound, for a report
};

/// Judges `answer` to a valid case by `standard`. A case outside the subject's preconditions gets not_asked, whatever
/// the answer. A rung on which an input may break a required precondition that has a border (has_border) proves
/// nothing: the answer may be right for that input by a rule of the library's own. Thread-safe. The result does not
/// depend on the caller's floating-point modes; this holds for every call of the oracle. Exact answers are those of the
/// conventions that the standard declares; what contradicts them is proved in the same way as without them.
///
/// `scene` holds for a subject that promises nothing: it replaces the measure where the scene states what it requires.
Finding judge(const Case& question, const Answer& answer, const Standard& standard, Detail detail,
              const SceneLimits* scene = scene_limits());

/// The exact answers to the case, enclosed by intervals and compared with the answer: the cheapest of all judgements,
/// without a verdict. Thread-safe. For an answer with the status answered.
Enclosure enclosure_of(const Case& question, const Answer& answer);

/// A lower bound of the backward error of the whole answer that is finer than the ladder: at least `proved`, the bound
/// of judge(), and below its next rung, in steps of 1/16 of the rung (of 1 on rung 0). Like a rung it is proved by
/// itself: no input within so many epsilon has an exact answer that matches, and every such input meets `required`. For
/// an answer with the status answered, by the conventions that are declared.
double finer_backward(const Case& question, const Answer& answer, const Backward& proved, Preconditions required = {},
                      Conventions declared = {});

/// A guide for a search, which proves nothing and which no finding uses: the forward error over the widening of the
/// enclosure of the exact answers for each epsilon of the inputs, so about the backward error in epsilon where it is
/// too small to be proved. 0 where the widening cannot be told. `forward_ulps` is that of judge().
double estimated_backward(const Case& question, const Answer& answer, double forward_ulps);

/// The margin to the nearest flip of the decision, a lower bound on the ladder: every input within so many epsilon has
/// the same decision. Negative where the intervals cannot decide even the case itself. As in Truth, without the
/// answers. A good `guess` at the result lowers the cost; no guess changes the result.
double decision_margin(const Case& question, double guess = 0);

/// The exact answers to a case, for people: all of them, and the margin to the nearest flip of the decision.
struct Truth {
  bool yes = false;
  Stage decided_by = Stage::interval;
  std::vector<Alternative> alternatives;
  /// The decision is the same for every input within this many epsilon of the case's scalar. Proved, on the ladder.
  /// Negative: the interval stage cannot decide even the input itself.
  double margin_at_least = -1;
  /// The rule of the query that makes a contact, or what seems to be one, a no: "the point starts inside the box".
  /// Empty for a yes, and where no rule is needed.
  std::string because;
};
/// By the conventions that are declared.
Truth truth_of(const Case& question, Conventions declared = {});
/// By no convention, with decimals of so many digits, at least 1 (decimal_of_digits).
Truth truth_in_digits(const Case& question, int digits);

/// The largest coordinate, size or offset of the case.
double largest_length(const Case& question);

/// The ladder's k-th rung: 0, 1, 2, 4 ... 2^50.
double rung(int k);
inline constexpr int rungs = 52;

/// How far each input number may move for a backward error of k: k * epsilon * the largest magnitude in its group,
/// rounded up. Flags and indices do not move.
std::vector<double> widening(const Query& query, std::span<const double> values, Scalar scalar, double k);

}  // namespace nearmiss
