#include "reports/triage/hypotheses/cause_of.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <span>
#include <utility>

#include "reports/engine/interrupt.hpp"
#include "reports/triage/hypotheses/hypotheses.hpp"
#include "reports/triage/hypotheses/predictions.hpp"
#include "reports/triage/hypotheses/readings.hpp"
#include "reports/triage/hypotheses/regions.hpp"
#include "reports/triage/hypotheses/relative_tolerance.hpp"
#include "reports/triage/hypotheses/tolerance.hpp"

namespace nearmiss {

namespace {

Tested constant_error_test(AskedCases& a) { return constant_error_of(a.trials(), a.scans()); }
Tested tolerance_test(AskedCases& a) {
  const bool flips = std::any_of(a.scans().begin(), a.scans().end(), std::mem_fn(&ScaleScan::has_clean_flip));
  const bool errs_to_both_sides = flips && a.is_wrong_decision() && a.errs_to_both_sides();
  Tested tested = tolerance_of(a.trials(), a.scans(), a.similar(), errs_to_both_sides);
  if (tested.named && tested.named->key.empty()) a.set_unknown_tolerance(*std::exchange(tested.named, std::nullopt));
  return tested;
}
Tested unknown_tolerance_test(AskedCases& a) { return {a.unknown_tolerance(), {}}; }
Tested relative_tolerance_test(AskedCases& a) { return relative_tolerance_of(a.trials(), a.similar()); }

using TestOfHypothesis = Tested (*)(AskedCases&);

/// What passes is shown by the answers themselves: they are right under another meaning, in other regions, or within
/// the range of a type.
constexpr TestOfHypothesis shown_by_answers[] = {number_range_of, convention_of, unsupported_of, certified_of};
/// What passes is inferred from changes of the case. Two may pass, and the right one may be either.
constexpr TestOfHypothesis inferred[] = {constant_error_test, tolerance_test,          unknown_tolerance_test,
                                         rounding_mode_of,    relative_tolerance_test, error_share_of,
                                         rounding_of,         times_of_steps_of,       errors_of_steps_of,
                                         starts_of_motion_of, grazing_contacts_of,     few_answers_of};
/// What is left where nothing else passed.
constexpr TestOfHypothesis left_over[] = {small_errors_of, logic_of};

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

/// Whether the case lies in the region, or its answer is explained by the reading, that is the cause; empty where the
/// cause is neither.
std::optional<bool> is_of_case(const Named& named, const AskedCases& asked) {
  const Case& c = asked.question();
  bool is_known = false;
  for (const Region& region : regions_of(*c.query)) {
    if (region.name != named.key) continue;
    if (region.has(c)) return true;
    is_known = true;
  }
  for (const auto readings : {readings(), readings_of_answers()}) {
    for (const Reading& reading : readings) {
      if (reading.name != named.key) continue;
      if (reading.right(c, asked.trials().base().answer, asked.is_right()).value_or(false)) return true;
      is_known = true;
    }
  }
  return is_known ? std::optional(false) : std::nullopt;
}

/// The causes of one case.
class CausesOfCase {
 public:
  CausesOfCase(AskedCases& asked, std::vector<Evidence>& evidence) : asked_(asked), evidence_(evidence) {}

  /// None, one, or two that cannot be told apart.
  std::vector<Named> result() {
    if (!is_bad(asked_.trials().base().finding)) {
      evidence_.push_back({"The subject was asked again.", "The finding is gone."});
      return {};
    }
    asked_.roundings(), asked_.scans(), asked_.similar();
    if (first_of(shown_by_answers) || all_of(inferred) || first_of(left_over)) return named_;
    return {};
  }

 private:
  bool first_of(std::span<const TestOfHypothesis> tests) {
    return std::any_of(tests.begin(), tests.end(), [&](TestOfHypothesis test) { return passes(test); });
  }
  bool all_of(std::span<const TestOfHypothesis> tests) {
    for (const TestOfHypothesis test : tests) passes(test);
    std::erase_if(named_, [&](const Named& n) { return speaks_against(evidence_, n.kind); });
    constexpr std::size_t most = 2;
    if (named_.size() > most) {
      evidence_.push_back({"The causes that passed their tests were compared.",
                           fmt::format("{} passed: nothing tells them apart.", named_.size())});
      named_.clear(), is_over_ = true;
    }
    return !named_.empty();
  }
  bool passes(TestOfHypothesis test) {
    if (is_over_) return false;
    if (asked_.trials().is_over()) {
      evidence_.push_back(
          {"The search has a limit of questions and of time.", "The limit was reached before every test was made."});
      is_over_ = true;
      return false;
    }
    Tested tested = test(asked_);
    std::move(tested.evidence.begin(), tested.evidence.end(), std::back_inserter(evidence_));
    if (!tested.named || !is_consistent(*tested.named, asked_, evidence_)) return false;
    add(std::move(*tested.named));
    return true;
  }
  /// Of two of a kind, the one with a key says more.
  void add(Named named) {
    for (Named& other : named_) {
      if (other.kind != named.kind) continue;
      if (other.key.empty()) other = std::move(named);
      return;
    }
    named_.push_back(std::move(named));
  }

  AskedCases& asked_;
  std::vector<Evidence>& evidence_;
  std::vector<Named> named_;
  bool is_over_ = false;
};

class CauseSearch {
 public:
  CauseSearch(const Subject& subject, const CauseLimits& limits, Workers& workers)
      : subject_(subject), limits_(limits), workers_(workers) {}

  Cause result(const Case& question) {
    cause_.text = "No hypothesis passed its test.";
    Trials trials(question, subject_, left(), workers_);
    AskedCases asked(trials);
    std::vector<Named> named = CausesOfCase(asked, cause_.evidence).result();
    count(trials);
    if (named.empty() && !interrupted() && is_bad(trials.base().finding)) named = named_from_others(question, asked);
    for (std::size_t i = 0; i < named.size(); ++i) {
      CauseName& into = i == 0 ? cause_ : cause_.either.emplace_back();
      into = {named[i].kind, std::move(named[i].key), std::move(named[i].text)};
    }
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

  /// What the tests found with another case.
  struct OfOther {
    std::vector<Named> named;
    std::vector<Evidence> evidence;
  };
  /// Makes the tests again with other cases that have the finding. Another case may be one of another bug. A region of
  /// the case, or a reading that explains its answer, is named: generated cases are the evidence of both. Of other
  /// causes, a second other case must have the same, and none before it another.
  std::vector<Named> named_from_others(const Case& question, AskedCases& asked) {
    std::size_t tried = 0;
    std::optional<OfOther> first;
    bool do_agree = true;
    for (const Case& other : others(question, asked)) {
      if (is_over()) break;
      OfOther found = of_other(other, asked);
      ++tried;
      if (found.named.empty()) continue;
      if (is_linked(found.named, asked)) return told(std::move(found), "");
      if (first && do_agree && are_same(first->named, found.named))
        return told(std::move(*first), " A second other case has the same cause.");
      if (first) do_agree = false;
      if (!first) first = std::move(found);
    }
    if (tried > 0)
      cause_.evidence.push_back({"Other cases with the same finding were taken in place of the case.",
                                 fmt::format("The tests were made again with {}, and {}.", tried,
                                             first ? "no two have the same cause" : "none passed")});
    return {};
  }
  /// What another case shows must hold for the case, too.
  OfOther of_other(const Case& other, AskedCases& asked) {
    Trials trials(other, subject_, left(), workers_);
    AskedCases of_other(trials);
    OfOther found;
    found.named = CausesOfCase(of_other, found.evidence).result();
    std::erase_if(found.named, [&](const Named& n) {
      return asked.is_refuted(n.key) || !is_of_case(n, asked).value_or(true) || contradiction_of(n, asked);
    });
    count(trials);
    return found;
  }
  static bool is_linked(const std::vector<Named>& named, const AskedCases& asked) {
    return std::all_of(named.begin(), named.end(),
                       [&](const Named& n) { return is_of_case(n, asked).value_or(false); });
  }
  std::vector<Named> told(OfOther found, std::string_view more) {
    cause_.evidence.push_back(
        {"Another case with the same finding was taken in place of the case, which may be a limiting one.",
         fmt::format("The tests were made again, as follows.{}", more)});
    std::move(found.evidence.begin(), found.evidence.end(), std::back_inserter(cause_.evidence));
    return std::move(found.named);
  }
  /// Causes of the same kinds with the same keys; a key may be missing in one.
  static bool are_same(const std::vector<Named>& some, const std::vector<Named>& others) {
    return std::equal(some.begin(), some.end(), others.begin(), others.end(), [](const Named& a, const Named& b) {
      return a.kind == b.kind && (a.key == b.key || a.key.empty() || b.key.empty());
    });
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
