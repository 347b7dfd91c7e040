/// Is a contact an exact touch, which any motion apart, however small, undoes?
#pragma once

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// Whether the contact that is the exact answer to the case, a yes, becomes a no when the first of the two things is
/// moved by 2^-300 of the largest number: then the two touch, or overlap by less than any scalar could tell. Looks in
/// two pairs of opposite directions that are parallel to nothing in particular, which tells every touch of convex
/// things.
bool touches_exactly(const Case& question);

/// The move of the generator that made the touch: "touch-by-size", "grazing"; "other" where none is named after one.
std::string_view feature_of_touch(const Case& question);

}  // namespace nearmiss
