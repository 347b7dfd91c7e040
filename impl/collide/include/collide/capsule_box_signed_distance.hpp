/// The signed distance of a capsule and a box, and the points that have it.
#pragma once

#include <collide/detail/signed_distances.hpp>

namespace collide {

/// The distance of the closed shapes, negative where they overlap, with a normal and two points. A radius of 0 is
/// allowed. A capsule whose ends are equal is a sphere. A half extent of 0 is allowed.
///
/// 1. point2 - point1 = distance * normal; the normal is a unit vector from `capsule` to `box`
/// 2. no point of `capsule` is further along the normal than point1, none of `box` less far than point2
///
/// Units: lengths; the normal has none. Never fails. Non-finite input: unspecified numbers. Source:
/// detail/signed_distances.hpp.
COLLIDE_SIGNED_DISTANCE_WITHIN(512, capsule_box_signed_distance, Capsule, capsule, Box, box)

}  // namespace collide
