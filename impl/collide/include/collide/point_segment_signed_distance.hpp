/// The signed distance of a point and a segment, and the points that have it.
#pragma once

#include <collide/detail/signed_distances.hpp>

namespace collide {

/// The distance of the closed shapes, negative where they overlap, with a normal and two points. A segment of length 0
/// is a point.
///
/// 1. point2 - point1 = distance * normal; the normal is a unit vector from `point` to `segment`
/// 2. no point of `point` is further along the normal than point1, none of `segment` less far than point2
///
/// Units: lengths; the normal has none. Never fails. Non-finite input: unspecified numbers. Source:
/// detail/signed_distances.hpp.
COLLIDE_SIGNED_DISTANCE(point_segment_signed_distance, Vec3, point, Segment, segment)

}  // namespace collide
