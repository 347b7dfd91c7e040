/// Whether a segment and a triangle overlap.
#pragma once

#include <collide/detail/overlaps_of_triangles.hpp>

namespace collide {

/// Whether the segment and the triangle meet. Touching is an overlap. A triangle has no front here; collinear vertices
/// are a segment.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/overlaps_of_triangles.hpp.
COLLIDE_OVERLAP(segment_triangle_overlap, Segment, segment, Triangle, triangle)

}  // namespace collide
