/// The time and place at which a moving point meets a segment.
#pragma once

#include <collide/detail/casts.hpp>
#include <collide/point_segment_signed_distance.hpp>

namespace collide {

/// The first contact of `point`, moving by `velocity` per unit of time, with `segment`. A segment may be a point.
///
/// An overlap at the start is a contact at time 0. A touch at the start is one too, unless the point moves away.
/// Without a contact the answer is a miss.
///
/// 1. location is a point of `segment` that the point touches at that time; of shapes that overlap at the start, one
/// that is
///    deepest
/// 2. normal is a unit vector from `segment` to `point` that no point of either is beyond, as for the signed distance
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source:
/// detail/casts.hpp.
COLLIDE_CAST(256, moving_point_segment, point_segment_signed_distance, Vec3, point, Segment, segment)

}  // namespace collide
