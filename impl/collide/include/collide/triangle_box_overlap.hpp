/// Whether a triangle and a box overlap.
#pragma once

#include <collide/detail/overlaps_of_boxes.hpp>

namespace collide {

/// Whether the triangle and the solid box meet. Touching is an overlap. A half extent of 0 is allowed. A triangle has
/// no front here; collinear vertices are a segment.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/overlaps_of_boxes.hpp.
// First order. A coordinate in the box's frame has an error of 19 eps of the distance from its center, at most 4 G, in
// three directions. The rest is aabox_triangle_overlap with coordinates of at most 2.6 times 2 G.
COLLIDE_OVERLAP_FUNCTION_WITHIN(448, triangle_box_overlap, Triangle, triangle, Box, box)

}  // namespace collide
