/// Whether two triangles overlap.
#pragma once

#include <collide/detail/overlaps_of_triangles.hpp>

namespace collide {

/// Whether the two triangles meet. Touching is an overlap. A triangle has no front here; collinear vertices are a
/// segment.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/overlaps_of_triangles.hpp.
COLLIDE_OVERLAP(triangle_triangle_overlap, Triangle, triangle1, Triangle, triangle2)

}  // namespace collide
