/// The time and place at which a moving point hits a one-sided plane.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_plane.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `point`, moving by `velocity` per unit of time, with the front of `plane`.
///
/// A hit requires normal . velocity < 0 and a start on the plane or in front of it; a start on the plane is a hit at
/// time 0. A start behind the plane, a motion parallel to it and zero velocity are misses.
///
/// 1. location == point + velocity * time (exactly, in real numbers)
/// 2. normal == plane.normal / |plane.normal|
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source: the plane's
/// equation along the line of motion, which is linear in time.
template <class Tier = Fast, class T>
[[nodiscard]] inline Impact<T> moving_point_plane(const Vec3<T>& point, const Vec3<T>& velocity,
                                                  const Plane<T>& plane) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_point_plane, Tier, point, velocity, plane);
}

namespace contracts {

/// First order. The computed height is that of a point whose coordinates are moved by 4 eps each, above a plane whose
/// offset is changed by 1 eps. The computed approach speed is that of a velocity changed by 3 eps, and the quotient
/// adds 1 eps. The location adds 2 eps of the displacement, which is at most as long as point and location together;
/// half of the error moves the point, half changes the velocity. The unit normal has an error of 4 eps, which rotates
/// the plane.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_plane() {
  return Tier::template contract<T>(
      {.backward = 16, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
