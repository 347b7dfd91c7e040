/// Generated cases for subjects with preconditions.
#pragma once

#include <cstdint>

#include "impl/catalogue/case.hpp"
#include "impl/subject/precondition.hpp"

namespace nearmiss {

/// Changes a valid case that breaks a precondition until it meets all of `required`, if possible: brings normals,
/// directions and quaternions to unit length, moves corners to those of a rectangle, replaces zero sizes and
/// velocities, and moves starts outside. Leaves a case that meets them unchanged. Gives the same result on every
/// machine; the case stays valid and exact in its scalar. Records a change in the case's origin. Returns whether the
/// case meets the preconditions.
bool fit(Case& c, Preconditions required);

/// The generator's case with that index, fitted. Each query, scalar and set of preconditions has its own stream.
/// Without preconditions, bit for bit the generator's stream.
void generate_inside(Case& into, const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index,
                     Preconditions required);

}  // namespace nearmiss
