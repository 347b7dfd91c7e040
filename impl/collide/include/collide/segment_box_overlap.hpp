/// Whether a segment and a box overlap.
#pragma once

#include <collide/detail/overlaps_of_boxes.hpp>

namespace collide {

/// Whether the segment and the solid box meet. Touching is an overlap. A half extent of 0 is allowed.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/overlaps_of_boxes.hpp.
COLLIDE_OVERLAP(segment_box_overlap, Segment, segment, Box, box)

}  // namespace collide
