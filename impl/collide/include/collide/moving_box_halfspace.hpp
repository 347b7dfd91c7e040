/// The time and place at which a moving box meets a half-space.
#pragma once

#include <collide/detail/casts_to_half_spaces.hpp>

namespace collide {

/// The first contact of `box`, moving by `velocity` per unit of time, with `halfspace`. A half extent of 0 is allowed.
///
/// An overlap at the start is a contact at time 0. A touch at the start is one too, unless the box moves away. A
/// box in front that does not approach is a miss.
///
/// 1. location is the point of the plane below the lowest point of `box` at that time; where several points are lowest,
/// the point below any of them
/// 2. normal == halfspace.normal / |halfspace.normal|
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source:
/// detail/casts_to_half_spaces.hpp.
COLLIDE_CAST_AGAINST_HALF_SPACE(128, moving_box_halfspace, Box, box)

}  // namespace collide
