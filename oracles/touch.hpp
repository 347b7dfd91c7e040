/// Finds exact touches: contacts that any motion apart, however small, ends.
#pragma once

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// Whether the exact answer to the case is yes and becomes no when the first operand moves by 2^-300 of the largest
/// number. Then the two operands touch, or overlap by less than any scalar can represent. Tries two pairs of opposite
/// directions in general position, which finds every touch of convex sets.
bool touches_exactly(const Case& question);

/// The name of the mutator that made the touch: "touch-by-size", "grazing"; "other" where no mutator of touches is
/// among the case's mutators.
std::string_view feature_of_touch(const Case& question);

}  // namespace nearmiss
