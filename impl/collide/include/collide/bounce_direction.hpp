/// The direction of a moving sphere after a bounce.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/bounce_direction.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The direction of `velocity`, reflected at the contact of a moving sphere. `time`, `location` and `normal` are those
/// of the impact. With u the vector from `location` to the sphere's center at `time` (or `normal` if that vector is
/// exactly zero), and d = velocity / |velocity|:
///
/// 1. direction == d - 2 (d . u) u / |u|^2
/// 2. |direction| == 1, or 0 for zero velocity
///
/// The sphere's radius and the lengths of u, normal and velocity do not matter. Units: none. Never fails. Non-finite
/// input: an unspecified direction. Source: mirror reflection in the plane perpendicular to u.
template <class Tier = Fast, class T>
[[nodiscard]] inline Direction<T> bounce_direction(const Sphere<T>& sphere, const Vec3<T>& velocity, T time,
                                                   const Vec3<T>& location,
                                                   const Vec3<T>& normal) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(bounce_direction, TierOfNumbers<Tier>, sphere, velocity, time, location, normal);
}

namespace contracts {

/// First order. The vector to the center has an error of 3 eps of the positions and of velocity * time, unit vectors
/// 4 eps, the dot product 3 eps, the reflection 3 eps. These errors rotate the direction; moving the location and the
/// velocity accounts for that. No perturbation accounts for a length other than 1: with_corrected_length() corrects the
/// length up to its last rounding.
template <class Tier = Fast, class T = double>
constexpr Contract bounce_direction() {
  return Tier::template contract<T>({.backward = 32, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
