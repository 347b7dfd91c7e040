/// The signed distance of two triangles, and the points that have it.
#pragma once

#include <collide/detail/signed_distances.hpp>

namespace collide {

/// The distance of the closed shapes, negative where they overlap, with a normal and two points. A triangle has no
/// front here; collinear vertices are a segment.
///
/// 1. point2 - point1 = distance * normal; the normal is a unit vector from `triangle1` to `triangle2`
/// 2. no point of `triangle1` is further along the normal than point1, none of `triangle2` less far than point2
///
/// Units: lengths; the normal has none. Never fails. Non-finite input: unspecified numbers. Source:
/// detail/signed_distances.hpp.
COLLIDE_SIGNED_DISTANCE_WITHIN(256, triangle_triangle_signed_distance, Triangle, triangle1, Triangle, triangle2)

}  // namespace collide
