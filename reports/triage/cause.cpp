#include "reports/triage/cause.hpp"

#include <algorithm>
#include <functional>
#include <iterator>

#include "reports/triage/convention.hpp"
#include "reports/triage/error_share.hpp"
#include "reports/triage/few_answers.hpp"
#include "reports/triage/logic.hpp"
#include "reports/triage/motion_steps.hpp"
#include "reports/triage/number_range.hpp"
#include "reports/triage/relative_tolerance.hpp"
#include "reports/triage/rounding.hpp"
#include "reports/triage/tolerance.hpp"
#include "reports/triage/unsupported.hpp"

namespace nearmiss {

namespace {

Tested constant_error_test(AskedCases& a) { return constant_error_of(a.trials(), a.scans()); }
Tested tolerance_test(AskedCases& a) {
  const bool flips = std::any_of(a.scans().begin(), a.scans().end(), std::mem_fn(&ScaleScan::has_clean_flip));
  return tolerance_of(a.trials(), a.scans(), a.similar(), flips && a.errs_to_both_sides());
}
Tested relative_tolerance_test(AskedCases& a) { return relative_tolerance_of(a.trials(), a.similar()); }

/// In the order of the hypotheses.
constexpr Tested (*tests_of_causes[])(AskedCases&) = {
    number_range_of,     convention_of,  unsupported_of,    constant_error_test,
    tolerance_test,      certified_of,   rounding_mode_of,  relative_tolerance_test,
    error_share_of,      rounding_of,    times_of_steps_of, errors_of_steps_of,
    starts_of_motion_of, few_answers_of, small_errors_of,   logic_of};

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
    if (tested.named) return tested.named;
  }
  return std::nullopt;
}

}  // namespace

Cause cause_of(const Report& report, const Subject& subject, const CauseLimits& limits, Workers& workers) {
  const std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  Trials trials(report.question, subject, limits, workers);
  AskedCases asked(trials);
  Cause cause;
  cause.text = "No hypothesis passed its test.";
  auto named = first_named(asked, cause.evidence);
  cause.questions = trials.questions();
  const bool goes_on = !named && !trials.is_over() && is_bad(trials.base().finding);
  if (const Trial* other = goes_on ? asked.plainest() : nullptr) {
    cause.evidence.push_back(
        {"Another case with the same finding was taken in place of the case, which may be a limiting one.",
         "The tests were made again, as follows."});
    Trials more(other->question, subject,
                {limits.questions - trials.questions(), limits.time - (std::chrono::steady_clock::now() - begin)},
                workers);
    AskedCases asked_more(more);
    named = first_named(asked_more, cause.evidence);
    cause.questions += more.questions();
  }
  if (named) cause.kind = named->kind, cause.key = named->key, cause.text = named->text;
  return cause;
}

std::string_view name_of(CauseKind kind) {
  switch (kind) {
    case CauseKind::rounding: return "rounding";
    case CauseKind::absolute_tolerance: return "absolute tolerance";
    case CauseKind::relative_tolerance: return "relative tolerance";
    case CauseKind::iteration_limit: return "iteration limit";
    case CauseKind::unsupported: return "unsupported";
    case CauseKind::overflow: return "overflow";
    case CauseKind::underflow: return "underflow";
    case CauseKind::convention: return "convention";
    case CauseKind::logic: return "logic";
    case CauseKind::unexplained: return "unexplained";
  }
  return "?";
}

}  // namespace nearmiss
