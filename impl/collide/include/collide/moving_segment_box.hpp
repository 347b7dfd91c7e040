/// The time and place at which a moving segment meets a box.
#pragma once

#include <collide/detail/casts.hpp>
#include <collide/segment_box_signed_distance.hpp>

namespace collide {

/// The first contact of `segment`, moving by `velocity` per unit of time, with `box`. A segment may be a point. A half
/// extent of 0 is allowed.
///
/// An overlap at the start is a contact at time 0. A touch at the start is one too, unless the segment moves away.
/// Without a contact the answer is a miss.
///
/// 1. location is a point of `box` that the segment touches at that time; of an overlap at the start, a deepest one
/// 2. normal is a unit vector from `box` to `segment` that no point of either is beyond, as for the signed distance
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source:
/// detail/casts.hpp.
COLLIDE_CAST(1024, moving_segment_box, segment_box_signed_distance, Segment, segment, Box, box)

}  // namespace collide
