/// Whether a box contains a point.
#pragma once

#include <collide/detail/overlaps_of_boxes.hpp>

namespace collide {

/// Whether the solid box contains `point`. Its surface belongs to it. A half extent of 0 is allowed.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/overlaps_of_boxes.hpp.
COLLIDE_OVERLAP_FUNCTION(point_box_overlap, Vec3, point, Box, box)

}  // namespace collide
