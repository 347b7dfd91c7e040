/// The direction in which a sphere slides on along a contact.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/slide_direction.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The direction of `velocity`, less its part across the contact of a moving sphere.
///
/// With u the vector from `location` to the sphere's center at `time` and d = velocity / |velocity|:
///
/// 1. direction == d - (d . u) u / |u|^2, so direction . u == 0; d itself where u is exactly zero
/// 2. |direction| is the sine of the angle between d and u, and 0 for zero velocity
///
/// The sphere's radius and the lengths of u and velocity play no part. Units: none. Source: u x (d x u),
/// which is at right angles to u also where nearly nothing is left of d.
template <class Tier = Fast, class T>
[[nodiscard]] Direction<T> slide_direction(const Sphere<T>& sphere, const Vec3<T>& velocity, T time,
                                           const Vec3<T>& location) noexcept(Tier::never_throws) {
  return kernels::slide_direction<Tier>(sphere, velocity, time, location);
}

namespace contracts {

/// First order: the vector to the center carries 3 eps of the positions and of velocity * time, unit
/// vectors 4 eps each, either cross product 3 eps: what they turn the direction is explained by moving the location and
/// the velocity by as much. The length, with the length of u squared, is off by 20 eps. A turn by k eps changes it by k
/// cosine eps, cosine that of d and u: 12 explain it where the cosine is above 1/2, with the 20 of the directions 32.
/// Below, where no turn explains it as the cosine nears 0, with_corrected_length() leaves 2^-8 eps, the error of
/// cosine^2, 20 eps of itself or 10 of the length times it, and a third of 20 cosine^2: a turn by 8 eps, beside the
/// last rounding.
template <class Tier = Fast, class T = double>
constexpr Contract slide_direction() {
  return Tier::template contract<T>({.backward = 32, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
