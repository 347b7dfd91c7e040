/// The time and place at which a moving segment meets a capsule.
#pragma once

#include <collide/detail/casts.hpp>
#include <collide/segment_capsule_signed_distance.hpp>

namespace collide {

/// The first contact of `segment`, moving by `velocity` per unit of time, with `capsule`. A radius of 0 is allowed. A
/// capsule whose ends are equal is a sphere. A segment may be a point.
///
/// An overlap at the start is a contact at time 0. A touch at the start is one too, unless the segment moves away.
/// Without a contact the answer is a miss.
///
/// 1. location is a point of `capsule` that the segment touches at that time; of shapes that overlap at the start, one
/// that is
///    deepest
/// 2. normal is a unit vector from `capsule` to `segment` that no point of either is beyond, as for the signed distance
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source:
/// detail/casts.hpp.
COLLIDE_CAST(256, moving_segment_capsule, segment_capsule_signed_distance, Segment, segment, Capsule, capsule)

}  // namespace collide
