/// When and where a moving point meets a sphere.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_sphere.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `point`, moving by `velocity` per unit of time, with `sphere`.
///
/// Solid: a start inside or on the surface is a contact at time 0, located at the point, the normal
/// from the center. Not solid: such a start gives the exit, the last time at which the point is on
/// the surface. From outside: the entry; touching counts. Zero velocity is a miss, but for a solid
/// start inside.
///
/// 1. |location - center| == radius, but for a solid start inside
/// 2. normal == (location - center) / |location - center|; at the center, of a solid or a sphere of radius 0, it is
///    against the motion
///
/// Source: the discriminant as the distance of the center from the line of motion (Haines, Guenther,
/// Akenine-Moeller, Precision Improvements for Ray/Sphere Intersection, 2019).
template <class Tier = Fast, class T>
[[nodiscard]] Impact<T> moving_point_sphere(const Vec3<T>& point, const Vec3<T>& velocity, const Sphere<T>& sphere,
                                            bool solid) noexcept(Tier::never_throws) {
  return kernels::moving_point_sphere<Tier>(point, velocity, sphere, solid);
}

namespace contracts {

/// First order, G the largest position: center to point is known to 2 eps G per axis; the closest
/// approach carries 9 eps of that distance (at most 4 G), its square and the radius 4 eps more; the
/// location 2 eps of 4 G.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_sphere() {
  return Tier::template contract<T>(
      {.backward = 64, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
