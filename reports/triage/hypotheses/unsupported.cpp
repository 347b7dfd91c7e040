#include "reports/triage/hypotheses/hypotheses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "corpus/generator/fit.hpp"
#include "corpus/generator/generator.hpp"
#include "oracles/judge.hpp"
#include "reports/triage/causes/shares.hpp"
#include "reports/triage/hypotheses/readings.hpp"
#include "reports/triage/hypotheses/regions.hpp"

namespace nearmiss {

namespace {

class Unsupported : public TestOfCause {
 public:
  using TestOfCause::TestOfCause;

  std::optional<Named> named() {
    for (const Region& region : regions_of(trials().query())) {
      if (!region.has(question())) continue;
      if (auto named = tested(region)) return named;
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t of_each_side = 64;  ///< generated cases inside and outside of a region
  static constexpr std::size_t least = 6;
  static constexpr std::size_t most_outside = 1;  ///< with the same finding, which then does not need the region

  /// Generated cases inside or outside of the region; those with the exact decision of the case alone, if so wanted.
  /// Another draw has other cases.
  std::vector<Trial> cases_of(const Region& region, bool inside, bool of_one_decision = false, std::uint64_t draw = 1) {
    constexpr std::uint64_t most_tries = 4000;
    const Preconditions required = trials().subject().offering(trials().query().name).required;
    std::vector<Case> cases;
    Case c;
    for (std::uint64_t i = 0; i < most_tries && cases.size() < of_each_side; ++i) {
      generate_inside(c, trials().query(), trials().subject().scalar, asked_.seed() + draw, i, required);
      if (has_extreme_mutator(c) || has_feature_mutator(c) || region.has(c) != inside) continue;
      if (!of_one_decision || exact_decision(c) == trials().base().finding.truth_yes) cases.push_back(c);
    }
    return trials().ask(cases);
  }
  /// Nearly all answers inside are wrong, and nearly all outside are right. Or nearly all inside have the finding, and
  /// no more than one outside: other bugs may have their own findings there.
  static bool divides(std::span<const Trial> in, std::span<const Trial> out) {
    const std::size_t in_all = count_answered(in), out_all = count_answered(out);
    if (in_all < least || out_all < least || count(out, Outcome::same) > most_outside) return false;
    return nearly_all(count(in, Outcome::same), in_all) ||
           (nearly_all(in_all - count(in, Outcome::right), in_all) && nearly_all(count(out, Outcome::right), out_all));
  }
  /// Other generated cases outside, which had no part in the choice of the region, are not proved to have the finding
  /// more often than it may be there: by the bound of Clopper and Pearson, at 95 %.
  bool holds_for_fresh_cases(const Region& region) {
    std::size_t all = 0, same = 0;
    for (const auto* list : {&asked_.sample(), &asked_.fresh()}) {
      for (const Trial& t : *list) {
        if (t.outcome != Outcome::none && !region.has(t.question)) ++all, same += t.outcome == Outcome::same;
      }
    }
    saw(fmt::format("Other cases without {} were generated.", region.name),
        fmt::format("{} have the finding.", of_text(same, all)));
    constexpr double may_be = double(most_outside) / of_each_side;
    return proved_at_least(same, all) <= may_be;
  }
  /// The decision is not the exact one, but too near to a touch for a proof.
  static bool is_undecided(const Trial& t) {
    return t.outcome == Outcome::right && t.answer.status == Answer::Status::answered &&
           t.answer.yes != t.finding.truth_yes;
  }
  /// Where the subject leaves out a region, nearly all answers inside are wrong. It is no cause where fewer are, with
  /// the exact decision of the case, by the bound of Clopper and Pearson: something else tells them apart. As none is
  /// wrong outside, a mistake of logic cannot be told from what else is particular inside.
  bool may_be_left_out(const Region& region, std::span<const Trial> in) {
    std::size_t all = 0, wrong = 0;
    const auto see = [&](const Trial& t) {
      if (t.outcome == Outcome::none || t.finding.truth_yes != trials().base().finding.truth_yes) return;
      if (!region.has(t.question) || is_undecided(t)) return;
      ++all, wrong += t.outcome != Outcome::right;
    };
    std::for_each(in.begin(), in.end(), see);
    for (const auto* list : {&asked_.sample(), &asked_.fresh()}) std::for_each(list->begin(), list->end(), see);
    if (proved_at_most(wrong, all) >= share_of_nearly_all) return true;
    saw(fmt::format("All generated cases with {} were counted.", region.name),
        fmt::format("{} are wrong: the region alone does not tell which.", of_text(wrong, all)), {CauseKind::logic});
    return false;
  }
  static Named always_wrong(const Region& region) {
    return {CauseKind::unsupported, region.name,
            fmt::format("The subject does not support {}: nearly every such answer is wrong.", region.name)};
  }
  static Named only_wrong(const Region& region) {
    return {CauseKind::unsupported, region.name,
            fmt::format("The subject does not support {}: only such answers are wrong.", region.name)};
  }
  /// Wrong answers, and those of them that are right under a meaning.
  struct Fit {
    std::size_t wrong = 0, explained = 0;
  };
  Fit fit_of(const Reading& reading, std::span<const Trial> in) const {
    Fit fit;
    for (const Trial& t : in) {
      if (t.outcome != Outcome::same && t.outcome != Outcome::other) continue;
      ++fit.wrong, fit.explained += reading.right(t.question, t.answer, asked_.is_right()).value_or(false);
    }
    return fit;
  }
  /// Right answers that are wrong under a meaning.
  std::size_t against(const Reading& reading, std::span<const Trial> in) const {
    return std::size_t(std::count_if(in.begin(), in.end(), [&](const Trial& t) {
      return t.outcome == Outcome::right && !reading.right(t.question, t.answer, asked_.is_right()).value_or(true);
    }));
  }
  /// Other cases of the region, which had no part in the choice of the meaning, are not proved to contradict it.
  bool holds_in_region(const Reading& reading, const Region& region, bool of_one_decision) {
    constexpr std::uint64_t other_draw = 4;
    const std::vector<Trial> others = cases_of(region, true, of_one_decision, other_draw);
    const auto [wrong, explained] = fit_of(reading, others);
    const std::size_t made_wrong = against(reading, others);
    saw(fmt::format("Other cases with {} were judged so.", region.name),
        fmt::format("{} wrong answers become right, and {} right ones wrong.", of_text(explained, wrong), made_wrong));
    return proved_at_most(explained, wrong) >= share_of_nearly_all &&
           proved_at_most(explained, explained + made_wrong) >= share_of_nearly_all;
  }
  /// Another meaning of the answer that explains nearly all wrong answers of the region says more than the region. One
  /// that explains most of them says that the region is not the cause. Meanings of the inputs and of the decision are
  /// not tried: a region where all answers are misses has many.
  std::optional<Named> told_by_meaning(const Region& region, std::span<const Trial> in, bool of_one_decision,
                                       std::optional<Named> otherwise) {
    for (const Reading& reading : readings_of_answers()) {
      if (reading.decides || asked_.is_wrong_decision()) continue;
      const auto [wrong, explained] = fit_of(reading, in);
      if (!most(explained, wrong)) continue;
      saw(fmt::format("The wrong answers with {} were judged as if {}.", region.name, reading.what),
          fmt::format("{} are right then.", of_text(explained, wrong)));
      const bool is_of_case = reading.right(question(), trials().base().answer, asked_.is_right()).value_or(false);
      const bool holds = nearly_all(explained, wrong) && nearly_all(explained, explained + against(reading, in));
      if (!holds || !is_of_case || !holds_in_region(reading, region, of_one_decision)) {
        asked_.refute(region.name);
        return std::nullopt;
      }
      return Named{reading.kind, std::string(reading.name),
                   fmt::format("With {}, the answer is right if {}.", region.name, reading.what),
                   predictions_of(reading)};
    }
    return otherwise;
  }
  std::optional<Named> tested(const Region& region) {
    const std::vector<Trial> in = cases_of(region, true), out = cases_of(region, false);
    const std::size_t in_right = count(in, Outcome::right), out_right = count(out, Outcome::right);
    const std::size_t in_all = count_answered(in), out_all = count_answered(out);
    saw(fmt::format("Generated cases with and without {} were asked.", region.name),
        fmt::format("Wrong are {} with it, and {} without it.", of_text(in_all - in_right, in_all),
                    of_text(out_all - out_right, out_all)));
    if (in_all < least || out_all < least) return std::nullopt;
    if (divides(in, out) && holds_for_fresh_cases(region))
      return told_by_meaning(region, in, false, always_wrong(region));
    std::vector<Trial> in_one;
    if (in_all > in_right && count(out, Outcome::same) <= most_outside) {
      in_one = cases_of(region, true, true);
      const std::vector<Trial> out_one = cases_of(region, false, true);
      saw(fmt::format("Only cases with the exact decision {} were asked.",
                      trials().base().finding.truth_yes ? "yes" : "no"),
          fmt::format("Right are {} with {}, and {} without it.",
                      of_text(count(in_one, Outcome::right), count_answered(in_one)), region.name,
                      of_text(count(out_one, Outcome::right), count_answered(out_one))));
      if (divides(in_one, out_one) && holds_for_fresh_cases(region))
        return told_by_meaning(region, in_one, true, always_wrong(region));
    }
    constexpr std::size_t least_outside = of_each_side / 2;
    const bool only_here = out_all >= least_outside && region.is_special && out_right == out_all &&
                           in_all - in_right >= least && !nearly_all(in_right, in_all);
    if (!only_here || !holds_for_fresh_cases(region)) return std::nullopt;
    return told_by_meaning(region, in, false,
                           may_be_left_out(region, in_one) ? std::optional(only_wrong(region)) : std::nullopt);
  }
};

}  // namespace

Tested unsupported_of(AskedCases& asked) {
  Unsupported test(asked);
  return test.finished(test.named());
}

}  // namespace nearmiss
