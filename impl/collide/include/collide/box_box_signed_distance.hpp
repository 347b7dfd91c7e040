/// The signed distance of two boxes, and the points that have it.
#pragma once

#include <collide/detail/signed_distances.hpp>

namespace collide {

/// The distance of the closed shapes, negative where they overlap, with a normal and two points. A half extent of 0 is
/// allowed.
///
/// 1. point2 - point1 = distance * normal; the normal is a unit vector from `box1` to `box2`
/// 2. no point of `box1` is further along the normal than point1, none of `box2` less far than point2
///
/// Units: lengths; the normal has none. Never fails. Non-finite input: unspecified numbers. Source:
/// detail/signed_distances.hpp.
COLLIDE_SIGNED_DISTANCE_WITHIN(512, box_box_signed_distance, Box, box1, Box, box2)

}  // namespace collide
