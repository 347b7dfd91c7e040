/// The signed distance of a triangle and a box, and the points that have it.
#pragma once

#include <collide/detail/signed_distances.hpp>

namespace collide {

/// The distance of the closed shapes, negative where they overlap, with a normal and two points. A triangle has no
/// front here; collinear vertices are a segment. A half extent of 0 is allowed.
///
/// 1. point2 - point1 = distance * normal; the normal is a unit vector from `triangle` to `box`
/// 2. no point of `triangle` is further along the normal than point1, none of `box` less far than point2
///
/// Units: lengths; the normal has none. Never fails. Non-finite input: unspecified numbers. Source:
/// detail/signed_distances.hpp.
COLLIDE_SIGNED_DISTANCE_WITHIN(512, triangle_box_signed_distance, Triangle, triangle, Box, box)

}  // namespace collide
