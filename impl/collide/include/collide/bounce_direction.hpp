/// The direction in which a sphere leaves a contact.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The direction of `velocity`, reflected at the contact of a moving sphere.
///
/// With u the vector from `location` to the sphere's center at `time`, or `normal` where that is
/// exactly zero, and d = velocity / |velocity|:
///
/// 1. direction == d - 2 (d . u) u / |u|^2
/// 2. |direction| == 1, or 0 for zero velocity
///
/// The sphere's radius and the lengths of u, normal and velocity play no part.
template <class Tier = Fast, class T>
Direction<T> bounce_direction(const Sphere<T>& sphere, const Vec3<T>& velocity, T time, const Vec3<T>& location,
                              const Vec3<T>& normal) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return bounce_direction<decltype(by)>(a...); }, sphere, velocity,
                      time, location, normal);
  }
  const Vec3<T> to_center = (sphere.center - location) + velocity * time;
  const bool apart = !(to_center == Vec3<T>{});
  const Vec3<T> u = unit<Tier>(apart ? to_center : normal);
  const Vec3<T> d = unit<Tier>(velocity);
  return {of_length<T>(d - u * (T(2) * Tier::dot(d, u)))};
}

namespace contracts {

/// First order: the vector to the center carries 3 eps of the positions and of velocity * time; unit
/// vectors 4 eps, the dot product 3, the reflection 3: what they turn the direction is explained by moving the location
/// and the velocity by as much. Nothing explains a length other than 1: of_length() leaves its last rounding.
template <class Tier = Fast, class T = double>
constexpr Contract bounce_direction() {
  return Tier::template contract<T>({.backward = 32, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
