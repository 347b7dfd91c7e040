/// The signed distance of a point and a box, and the points that have it.
#pragma once

#include <collide/detail/signed_distances.hpp>

namespace collide {

/// The distance of the closed shapes, negative where they overlap, with a normal and two points. A half extent of 0 is
/// allowed.
///
/// 1. point2 - point1 = distance * normal; the normal is a unit vector from `point` to `box`
/// 2. no point of `point` is further along the normal than point1, none of `box` less far than point2
///
/// Units: lengths; the normal has none. Never fails. Non-finite input: unspecified numbers. Source:
/// detail/signed_distances.hpp.
COLLIDE_SIGNED_DISTANCE_WITHIN(512, point_box_signed_distance, Vec3, point, Box, box)

}  // namespace collide
