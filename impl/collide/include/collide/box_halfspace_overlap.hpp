/// Whether a box and a half-space overlap.
#pragma once

#include <collide/detail/half_spaces.hpp>

namespace collide {

/// Whether the closed box and the closed half-space meet. Touching is an overlap. A half extent of 0 is allowed.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/half_spaces.hpp.
COLLIDE_OVERLAP_WITH_HALF_SPACE(96, box_halfspace_overlap, Box, box, HalfSpace, halfspace)

}  // namespace collide
