/// Whether a capsule and a box overlap.
#pragma once

#include <collide/detail/overlaps_of_boxes.hpp>

namespace collide {

/// Whether the closed capsule and the solid box meet. Touching is an overlap. A radius of 0 is allowed. A half extent
/// of 0 is allowed.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/overlaps_of_boxes.hpp.
COLLIDE_OVERLAP(capsule_box_overlap, Capsule, capsule, Box, box)

}  // namespace collide
