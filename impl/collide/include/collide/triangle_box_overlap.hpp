/// Whether a triangle and a box overlap.
#pragma once

#include <collide/detail/overlaps_of_boxes.hpp>

namespace collide {

/// Whether the triangle and the solid box meet. Touching is an overlap. A half extent of 0 is allowed. A triangle has
/// no front here; collinear vertices are a segment.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/overlaps_of_boxes.hpp.
COLLIDE_OVERLAP_FUNCTION(triangle_box_overlap, Triangle, triangle, Box, box)

}  // namespace collide
