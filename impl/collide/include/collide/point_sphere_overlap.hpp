/// Whether a sphere contains a point.
#pragma once

#include <collide/detail/overlaps.hpp>

namespace collide {

/// Whether the closed ball contains `point`. Its surface belongs to it. A radius of 0 is allowed.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/overlaps.hpp.
COLLIDE_OVERLAP(point_sphere_overlap, Vec3, point, Sphere, sphere)

}  // namespace collide
