/// The exact decision of a case, without a judgement.
#pragma once

#include <optional>
#include <span>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// The exact decision alone, at the least cost. Thread-safe.
bool exact_decision(const Case& question);

/// The exact decision of every input of which each number lies within `moves` (one distance per number, not negative)
/// of the case's number, where intervals prove that it is the same for all of them. Empty: not proved. The proof allows
/// every such input of the reals that is valid; the numbers of the case need not be numbers of its scalar. Thread-safe.
std::optional<bool> decision_within(const Case& question, std::span<const double> moves);

}  // namespace nearmiss
