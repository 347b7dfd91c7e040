/// Whether a capsule and a triangle overlap.
#pragma once

#include <collide/detail/overlaps_of_triangles.hpp>

namespace collide {

/// Whether the closed capsule and the triangle meet. Touching is an overlap. A radius of 0 is allowed. A triangle has
/// no front here; collinear vertices are a segment.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/overlaps_of_triangles.hpp.
COLLIDE_OVERLAP(capsule_triangle_overlap, Capsule, capsule, Triangle, triangle)

}  // namespace collide
