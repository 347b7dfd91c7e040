/// The time and place at which a moving box meets another one.
#pragma once

#include <collide/box_box_signed_distance.hpp>
#include <collide/detail/casts.hpp>

namespace collide {

/// The first contact of `box`, moving by `velocity` per unit of time, with `fixed`. A half extent of 0 is allowed.
///
/// An overlap at the start is a contact at time 0. A touch at the start is one too, unless the box moves away. Without
/// a contact the answer is a miss.
///
/// 1. location is a point of `fixed` that the box touches at that time; of an overlap at the start, a deepest one
/// 2. normal is a unit vector from `fixed` to `box` that no point of either is beyond, as for the signed distance
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source:
/// detail/casts.hpp.
COLLIDE_CAST(1024, moving_box_box, box_box_signed_distance, Box, box, Box, fixed)

}  // namespace collide
