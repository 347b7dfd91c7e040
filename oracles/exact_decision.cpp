#include "oracles/exact_decision.hpp"

#include <vector>

#include "impl/subject/floating_point.hpp"
#include "oracles/exact/oracle.hpp"

namespace nearmiss {

std::optional<bool> decision_within(const Case& question, std::span<const double> moves) {
  const FloatingPointScope standard_modes;
  const Answer none{};
  const Enclosure all = oracle_of(*question.query).interval(question.values, moves, none, question.scalar);
  return all.decided() ? std::optional(all.may_be_yes) : std::nullopt;
}

bool exact_decision(const Case& question) {
  const std::vector<double> no_moves(question.values.size());
  if (const auto decision = decision_within(question, no_moves)) return *decision;
  const FloatingPointScope standard_modes;
  const Answer none{};
  return oracle_of(*question.query).exact(question.values, none, question.scalar, nullptr).may_be_yes;
}

}  // namespace nearmiss
