/// The signed distance of two spheres, and the points that have it.
#pragma once

#include <collide/detail/signed_distances.hpp>

namespace collide {

/// The distance of the closed shapes, negative where they overlap, with a normal and two points. A radius of 0 is
/// allowed.
///
/// 1. point2 - point1 = distance * normal; the normal is a unit vector from `sphere1` to `sphere2`
/// 2. no point of `sphere1` is further along the normal than point1, none of `sphere2` less far than point2
///
/// Units: lengths; the normal has none. Never fails. Non-finite input: unspecified numbers. Source:
/// detail/signed_distances.hpp.
COLLIDE_SIGNED_DISTANCE(sphere_sphere_signed_distance, Sphere, sphere1, Sphere, sphere2)

}  // namespace collide
