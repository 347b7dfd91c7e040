/// A case with the back of its one-sided shape as the front.
#pragma once

#include <optional>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// With a reversed plane, or two corners of the triangle or rectangle exchanged; empty where no operand has a front.
std::optional<Case> seen_from_behind(const Case& question);
/// The answer to such a case in the order of the corners of the other one: the weights of the exchanged corners of a
/// triangle are exchanged too.
Answer seen_from_behind(const Case& question, Answer answer);

}  // namespace nearmiss
