/// The signed distance of a segment and a triangle, and the points that have it.
#pragma once

#include <collide/detail/signed_distances.hpp>

namespace collide {

/// The distance of the closed shapes, negative where they overlap, with a normal and two points. A segment of length 0
/// is a point. A triangle has no front here; collinear vertices are a segment.
///
/// 1. point2 - point1 = distance * normal; the normal is a unit vector from `segment` to `triangle`
/// 2. no point of `segment` is further along the normal than point1, none of `triangle` less far than point2
///
/// Units: lengths; the normal has none. Never fails. Non-finite input: unspecified numbers. Source:
/// detail/signed_distances.hpp.
COLLIDE_SIGNED_DISTANCE_WITHIN(256, segment_triangle_signed_distance, Segment, segment, Triangle, triangle)

}  // namespace collide
