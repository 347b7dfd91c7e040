/// When and where a moving point meets a one-sided plane.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_plane.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `point`, moving by `velocity` per unit of time, with the front of `plane`.
///
/// A hit needs normal . velocity < 0 and a start on the plane or in front of it. A start behind, a
/// motion along the plane and zero velocity are misses.
///
/// 1. location == point + velocity * time (exactly, in real numbers)
/// 2. normal == plane.normal / |plane.normal|
///
/// Source: the plane's equation along the line of motion, linear in time.
template <class Tier = Fast, class T>
[[nodiscard]] Impact<T> moving_point_plane(const Vec3<T>& point, const Vec3<T>& velocity,
                                           const Plane<T>& plane) noexcept(Tier::never_throws) {
  return kernels::moving_point_plane<Tier>(point, velocity, plane);
}

namespace contracts {

/// First order: the height is that of a point whose coordinates moved by 4 eps each, over a plane whose
/// offset moved by 1 eps; the approach that of a velocity moved by 3 eps, 1 eps more for the quotient. The
/// location adds 2 eps of the way, which is at most as long as point and location together: half of it
/// moves the point, half the velocity. A unit normal carries 4 eps, which turns the plane.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_plane() {
  return Tier::template contract<T>(
      {.backward = 16, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
