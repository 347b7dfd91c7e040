#include "reports/triage/hypotheses/hypotheses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "corpus/generator/case_builder.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {

namespace {

class FewAnswers : public TestOfCause {
 public:
  using TestOfCause::TestOfCause;

  std::optional<Named> named() {
    if (!find_number() || exact_number(question()).empty()) return std::nullopt;
    for (const Operand& operand : question().operands()) {
      const auto counted = operand.positions.empty() ? std::nullopt : counted_with(operand);
      if (!counted) continue;
      saw(fmt::format("{} was moved by different distances up to {:.2g}.", operand.name, counted->furthest),
          fmt::format("{} different exact values have {} given ones.", counted->exact, counted->given));
      return Named{CauseKind::iteration_limit, "steps of the answer",
                   "The number is one of a few, while the exact one changes with the inputs: the subject looks at few "
                   "places."};
    }
    saw("The operands were moved by different small distances.", "The given number changes with the exact one.");
    return std::nullopt;
  }

 private:
  static constexpr std::size_t moves = 48, least_given = 3, shared = 3;

  bool find_number() {
    const Finding full = trials().in_full(trials().base());
    const MemberFinding* member = full.headline_member();
    if (member == nullptr || member->worst < 0) return false;
    number_ = std::size_t(member->worst);
    const Role role = trials().query().outputs[number_].role;
    return role != Role::index && role != Role::flag;
  }
  Case moved(const Operand& operand, double by) const {
    Case c = question();
    for (const std::size_t at : operand.positions) {
      for (std::size_t i = at; i < at + 3; ++i) c.values[i] = rounded_to(c.scalar, c.values[i] + by);
    }
    return c;
  }
  std::vector<double> exact_number(const Case& c) const {
    for (const Alternative& right : truth_of(c).alternatives) {
      if (right.yes && number_ < right.count) return {right.values[number_].low};
    }
    return {};
  }
  /// The length of the shortest move that changes the given number, where a move of a quarter does not, though it
  /// changes the exact number; empty where there is none.
  std::optional<double> end_of_plateau(const Operand& operand) {
    constexpr int coarsest = -4, step = 2, bits_of_rounding = 6;  // rounded numbers have plateaus too
    const int finest = std::max(-34, bits_of_rounding + std::ilogb(unit_roundoff(question().scalar)));
    const double own = trials().base().answer.values[number_];
    const auto& inputs = question().values;
    if (std::find(inputs.begin(), inputs.end(), own) != inputs.end()) return std::nullopt;  // a corner, not a step
    std::vector<Case> cases;
    std::vector<double> lengths;
    for (int order = finest; order <= coarsest; order += step) {
      lengths.push_back(std::ldexp(1.0, largest_exponent_of(question()) + order));
      cases.push_back(moved(operand, lengths.back()));
    }
    const std::vector<Trial> asked = trials().ask(cases);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const Answer& a = asked[i].answer;
      if (asked[i].outcome == Outcome::none || a.status != Answer::Status::answered || !a.yes) return std::nullopt;
      if (a.values[number_] == own) continue;
      const bool is_plateau = i > 1 && exact_number(cases[i - 1]) != exact_number(question());
      return is_plateau ? std::optional(lengths[i]) : std::nullopt;
    }
    return std::nullopt;
  }
  /// How many different numbers there are, where the given ones are few; empty where they are not. The case may lie
  /// near the end of a step: the moves grow until they pass several.
  struct Counted {
    std::size_t exact = 0, given = 0;
    double furthest = 0;
  };
  std::optional<Counted> counted_with(const Operand& operand) {
    constexpr int tries = 6;
    constexpr double longer = 4;
    const auto plateau = end_of_plateau(operand);
    double furthest = plateau.value_or(0);
    for (int n = 0; plateau && n < tries; ++n) {
      furthest *= longer;
      const auto counted = counted_up_to(operand, furthest);
      if (!counted) return std::nullopt;
      const bool are_few = shared * counted->given <= moves && most(counted->exact, moves);
      if (counted->given >= least_given) return are_few ? counted : std::nullopt;
    }
    return std::nullopt;
  }
  /// Empty where an answer is none.
  std::optional<Counted> counted_up_to(const Operand& operand, double furthest) {
    std::vector<Case> cases;
    for (std::size_t n = 1; n <= moves; ++n) cases.push_back(moved(operand, furthest * double(n) / moves));
    std::set<double> given, exact;
    for (const Trial& t : trials().ask(cases)) {
      if (t.answer.status != Answer::Status::answered || !t.answer.yes || t.outcome == Outcome::none)
        return std::nullopt;
      given.insert(t.answer.values[number_]);
      const auto value = exact_number(t.question);
      exact.insert(value.begin(), value.end());
    }
    return Counted{exact.size(), given.size(), furthest};
  }

  std::size_t number_ = 0;
};

}  // namespace

Tested few_answers_of(AskedCases& asked) {
  FewAnswers test(asked);
  return test.finished(test.named());
}

}  // namespace nearmiss
