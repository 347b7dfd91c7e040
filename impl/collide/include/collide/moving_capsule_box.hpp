/// The time and place at which a moving capsule meets a box.
#pragma once

#include <collide/capsule_box_signed_distance.hpp>
#include <collide/detail/casts.hpp>

namespace collide {

/// The first contact of `capsule`, moving by `velocity` per unit of time, with `box`. A radius of 0 is allowed. A
/// capsule whose ends are equal is a sphere. A half extent of 0 is allowed.
///
/// An overlap at the start is a contact at time 0. A touch at the start is one too, unless the capsule moves away.
/// Without a contact the answer is a miss.
///
/// 1. location is a point of `box` that the capsule touches at that time; of an overlap at the start, a deepest one
/// 2. normal is a unit vector from `box` to `capsule` that no point of either is beyond, as for the signed distance
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source:
/// detail/casts.hpp.
COLLIDE_CAST(1024, moving_capsule_box, capsule_box_signed_distance, Capsule, capsule, Box, box)

}  // namespace collide
