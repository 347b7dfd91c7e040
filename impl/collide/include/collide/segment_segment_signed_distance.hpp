/// The signed distance of two segments, and the points that have it.
#pragma once

#include <collide/detail/signed_distances.hpp>

namespace collide {

/// The distance of the closed shapes, negative where they overlap, with a normal and two points. A segment of length 0
/// is a point.
///
/// 1. point2 - point1 = distance * normal; the normal is a unit vector from `segment1` to `segment2`
/// 2. no point of `segment1` is further along the normal than point1, none of `segment2` less far than point2
///
/// Units: lengths; the normal has none. Never fails. Non-finite input: unspecified numbers. Source:
/// detail/signed_distances.hpp.
COLLIDE_SIGNED_DISTANCE(segment_segment_signed_distance, Segment, segment1, Segment, segment2)

}  // namespace collide
