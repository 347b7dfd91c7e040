/// Whether a sphere contains a point.
#pragma once

#include <collide/detail/overlaps.hpp>
#include <collide/detail/sphere_sphere_overlap.hpp>

namespace collide {

namespace kernels {

template <class Tier, class T>
inline Decision<T> point_sphere_overlap(const Vec3<T>& point, const Sphere<T>& sphere) {
  return kernels::sphere_sphere_overlap<Tier>(Sphere<T>{point, T(0)}, sphere);
}

}  // namespace kernels

/// Whether the closed ball contains `point`. Its surface belongs to it. A radius of 0 is allowed.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/overlaps.hpp.
COLLIDE_OVERLAP_FUNCTION(point_sphere_overlap, Vec3, point, Sphere, sphere)

}  // namespace collide
