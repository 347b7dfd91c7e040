/// The direction in which a moving sphere slides along a contact.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/slide_direction.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The direction of `velocity` without its component normal to the contact of a moving sphere. `time` and `location`
/// are those of the impact. With u the vector from `location` to the sphere's center at `time`, and d =
/// velocity / |velocity|:
///
/// 1. direction == d - (d . u) u / |u|^2, so direction . u == 0; d itself if u is exactly zero
/// 2. |direction| is the sine of the angle between d and u, and 0 for zero velocity
///
/// The result is not normalized. The sphere's radius and the lengths of u and velocity do not matter. Units: none.
/// Never fails. Non-finite input: an unspecified direction. Source: u x (d x u), which is perpendicular to u even where
/// it is much shorter than d.
template <class Tier = Fast, class T>
[[nodiscard]] inline Direction<T> slide_direction(const Sphere<T>& sphere, const Vec3<T>& velocity, T time,
                                                  const Vec3<T>& location) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(slide_direction, TierOfNumbers<Tier>, sphere, velocity, time, location);
}

namespace contracts {

/// First order. The vector to the center has an error of 3 eps of the positions and of velocity * time, unit vectors
/// 4 eps each, either cross product 3 eps. These errors rotate the direction; moving the location and the velocity
/// accounts for that. The length, which includes the squared length of u, has an error of 20 eps. A rotation by k eps
/// changes it by k cosine eps, with the cosine of the angle between d and u. If that cosine is above 1/2, a rotation by
/// 12 eps accounts for the error; with the 20 eps of the directions that is 32. If it is smaller, no rotation accounts
/// for the error as the cosine approaches 0. with_corrected_length() then leaves 2^-8 eps, the error of cosine^2
/// (20 eps of itself, or 10 of the length times it), and a third of 20 cosine^2: a rotation by 8 eps, besides the last
/// rounding.
template <class Tier = Fast, class T = double>
constexpr Contract slide_direction() {
  return Tier::template contract<T>({.backward = 32, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
