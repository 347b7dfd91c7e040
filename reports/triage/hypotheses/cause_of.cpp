#include "reports/triage/hypotheses/cause_of.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "reports/engine/interrupt.hpp"
#include "reports/triage/hypotheses/hypotheses.hpp"
#include "reports/triage/hypotheses/predictions.hpp"
#include "reports/triage/hypotheses/relative_tolerance.hpp"
#include "reports/triage/hypotheses/tolerance.hpp"

namespace nearmiss {

namespace {

Tested constant_error_test(AskedCases& a) { return constant_error_of(a.trials(), a.scans()); }
Tested tolerance_test(AskedCases& a) {
  const bool flips = std::any_of(a.scans().begin(), a.scans().end(), std::mem_fn(&ScaleScan::has_clean_flip));
  Tested tested = tolerance_of(a.trials(), a.scans(), a.similar(), flips && a.errs_to_both_sides());
  if (tested.named && tested.named->key.empty()) a.set_unknown_tolerance(*std::exchange(tested.named, std::nullopt));
  return tested;
}
/// A scale at which rounding errors become visible looks like that of a tolerance.
Tested unknown_tolerance_test(AskedCases& a) { return {a.unknown_tolerance(), {}}; }
Tested relative_tolerance_test(AskedCases& a) { return relative_tolerance_of(a.trials(), a.similar()); }

/// In the order of the hypotheses.
constexpr Tested (*tests_of_causes[])(AskedCases&) = {number_range_of,
                                                      convention_of,
                                                      unsupported_of,
                                                      constant_error_test,
                                                      tolerance_test,
                                                      certified_of,
                                                      rounding_mode_of,
                                                      unknown_tolerance_test,
                                                      relative_tolerance_test,
                                                      error_share_of,
                                                      rounding_of,
                                                      times_of_steps_of,
                                                      errors_of_steps_of,
                                                      starts_of_motion_of,
                                                      grazing_contacts_of,
                                                      few_answers_of,
                                                      small_errors_of,
                                                      logic_of};

bool speaks_against(const std::vector<Evidence>& evidence, CauseKind kind) {
  return std::any_of(evidence.begin(), evidence.end(), [kind](const Evidence& e) {
    return std::find(e.against.begin(), e.against.end(), kind) != e.against.end();
  });
}

/// Nothing that was seen speaks against the cause, and all that it predicts holds.
bool is_consistent(const Named& named, AskedCases& asked, std::vector<Evidence>& evidence) {
  if (speaks_against(evidence, named.kind)) return false;
  auto contradiction = contradiction_of(named, asked);
  if (contradiction) evidence.push_back(std::move(*contradiction));
  return !contradiction;
}

std::optional<Named> first_named(AskedCases& asked, std::vector<Evidence>& evidence) {
  if (!is_bad(asked.trials().base().finding)) {
    evidence.push_back({"The subject was asked again.", "The finding is gone."});
    return std::nullopt;
  }
  asked.roundings(), asked.scans();
  for (const auto& test : tests_of_causes) {
    if (asked.trials().is_over()) {
      evidence.push_back(
          {"The search has a limit of questions and of time.", "The limit was reached before every test was made."});
      return std::nullopt;
    }
    Tested tested = test(asked);
    std::move(tested.evidence.begin(), tested.evidence.end(), std::back_inserter(evidence));
    if (tested.named && is_consistent(*tested.named, asked, evidence)) return tested.named;
  }
  return std::nullopt;
}

class CauseSearch {
 public:
  CauseSearch(const Subject& subject, const CauseLimits& limits, Workers& workers)
      : subject_(subject), limits_(limits), workers_(workers) {}

  Cause result(const Case& question) {
    cause_.text = "No hypothesis passed its test.";
    Trials trials(question, subject_, left(), workers_);
    AskedCases asked(trials);
    auto named = first_named(asked, cause_.evidence);
    count(trials);
    if (!named && !interrupted() && is_bad(trials.base().finding)) named = named_from_others(question, asked);
    if (named) cause_.kind = named->kind, cause_.key = named->key, cause_.text = named->text;
    return std::move(cause_);
  }

 private:
  static constexpr std::uint64_t questions_of_a_case = 4000;
  static constexpr std::size_t most_others = 4;

  /// For one case, of what is left.
  CauseLimits left() const {
    const std::uint64_t questions = limits_.questions - std::min(limits_.questions, cause_.questions);
    return {std::min(questions, questions_of_a_case), limits_.time - (Clock::now() - begin_)};
  }
  bool is_over() const { return interrupted() || left().questions == 0 || left().time.count() <= 0; }
  void count(const Trials& trials) { cause_.questions += trials.questions(); }

  /// Makes the tests again with other cases that have the finding. The evidence is that of the case that names a cause.
  std::optional<Named> named_from_others(const Case& question, AskedCases& asked) {
    std::size_t tried = 0;
    for (const Case& other : others(question, asked)) {
      if (is_over()) break;
      Trials trials(other, subject_, left(), workers_);
      AskedCases of_other(trials);
      std::vector<Evidence> evidence;
      const auto named = first_named(of_other, evidence);
      count(trials), ++tried;
      if (!named) continue;
      cause_.evidence.push_back(
          {"Another case with the same finding was taken in place of the case, which may be a limiting one.",
           "The tests were made again, as follows."});
      std::move(evidence.begin(), evidence.end(), std::back_inserter(cause_.evidence));
      return named;
    }
    if (tried > 0)
      cause_.evidence.push_back({"Other cases with the same finding were taken in place of the case.",
                                 fmt::format("The tests were made again with {}, and none passed.", tried)});
    return std::nullopt;
  }
  /// The plainest of the cases that were asked, and generated cases, the plainest first.
  std::vector<Case> others(const Case& question, AskedCases& asked) {
    std::vector<Case> chosen;
    if (const Trial* t = asked.plainest()) chosen.push_back(t->question);
    if (is_over()) return chosen;
    Trials trials(question, subject_, left(), workers_);
    AskedCases more(trials);
    for (Trial& t : more.generated_with_finding(2 * most_others)) {
      if (chosen.size() < most_others && (chosen.empty() || t.question.values != chosen.front().values))
        chosen.push_back(std::move(t.question));
    }
    count(trials);
    return chosen;
  }

  using Clock = std::chrono::steady_clock;

  const Subject& subject_;
  const CauseLimits& limits_;
  Workers& workers_;
  Clock::time_point begin_ = Clock::now();
  Cause cause_;
};

}  // namespace

Cause cause_of(const Report& report, const Subject& subject, const CauseLimits& limits, Workers& workers) {
  return CauseSearch(subject, limits, workers).result(report.question);
}

}  // namespace nearmiss
