/// Cases for subjects that require something of their callers.
#pragma once

#include <cstdint>

#include "impl/catalogue/case.hpp"
#include "impl/subject/precondition.hpp"

namespace nearmiss {

/// Changes a valid case that is outside of what is required so that it is inside, if that can be done: normals,
/// directions and quaternions are brought to unit length, corners to those of a rectangle, zero sizes and velocities
/// replaced, and starts moved out. A case that is inside stays as it is. The same on every machine; the case stays
/// valid and exact in its scalar. Where it is changed its origin says so. True if it is inside now.
bool fit(Case& c, Preconditions required);

/// The generator's case of that number, fitted: a stream of its own for each query, scalar and set of preconditions.
/// Without any, bit for bit the generator's.
void generate_inside(Case& into, const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index,
                     Preconditions required);

}  // namespace nearmiss
