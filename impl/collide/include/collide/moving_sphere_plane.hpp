/// When and where a moving sphere meets a one-sided plane.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_sphere_plane.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `sphere`, moving by `velocity` per unit of time, with the front of `plane`.
///
/// A contact needs normal . velocity <= 0 and a sphere that does not start wholly behind the plane. A sphere
/// that reaches both sides, or touches the plane, is a contact at time 0.
///
/// 1. location is the point of the plane nearest to the center at that time
/// 2. normal == plane.normal / |plane.normal|
///
/// Source: the height of the center above the plane, linear in time.
template <class Tier = Fast, class T>
[[nodiscard]] Impact<T> moving_sphere_plane(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                            const Plane<T>& plane) noexcept(Tier::never_throws) {
  return kernels::moving_sphere_plane<Tier>(sphere, velocity, plane);
}

namespace contracts {

/// First order: the height is that of a center whose coordinates moved by 4 eps each, over a plane whose
/// offset moved by 1 eps; the reach that of a radius moved by 7 eps, and their difference 1 eps more; the
/// approach that of a velocity moved by 3 eps, 1 eps more for the quotient. The location adds 4 eps of the
/// way and 4 eps of the radius; the way is at most as long as center and contact together. A unit normal
/// carries 4 eps, which turns the plane.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_plane() {
  return Tier::template contract<T>(
      {.backward = 32, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
