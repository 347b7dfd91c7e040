/// Tells a border between two kinds of cases from an answer that is right or wrong by chance.
#pragma once

#include <span>

#include "reports/triage/trials/trials.hpp"

namespace nearmiss {

/// Whether a plane through the space of the inputs separates the cases with the finding from those without: the cases
/// lie on both sides of a border, such as an exact touch or a condition of the subject. Of 64 cases whose outcome is a
/// matter of chance, a plane in up to 20 numbers separates hardly any (Cover, Geometrical and Statistical Properties of
/// Systems of Linear Inequalities, 1965). `trials` are neighbours of `about`. A search that may miss a plane, never
/// invents one.
bool are_on_two_sides(const Case& about, std::span<const Trial> trials);

}  // namespace nearmiss
