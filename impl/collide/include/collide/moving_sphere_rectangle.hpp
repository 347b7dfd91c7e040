/// The time and place at which a moving sphere hits a one-sided rectangle.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_sphere_rectangle.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `sphere`, moving by `velocity` per unit of time, with `rectangle`: the earlier contact with its
/// two triangles v0, v1, v2 and v0, v2, v3. Each triangle is hit only from its own front, under the conditions of
/// moving_sphere_triangle, which also states touching and degenerate cases. If both are hit at the same time, the
/// result is either.
///
/// 1. |center + velocity * time - location| == radius, except for an overlap at the start
/// 2. normal points from location to the center; for a center on the rectangle it is an outward normal
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source:
/// moving_sphere_triangle, twice; a parallelogram has one plane and one border, so once.
template <class Tier = Fast, class T>
[[nodiscard]] inline Impact<T> moving_sphere_rectangle(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                                       const Rectangle<T>& rectangle) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_sphere_rectangle, TierOfDecisions<Tier>, sphere, velocity, rectangle);
}

namespace contracts {

/// As moving_sphere_triangle. The same changes of the sphere's numbers account for the errors of both triangles, as do
/// changes of each triangle's own corner. The two common corners are moved for both triangles, by twice as much. A
/// rectangle that `Fast` takes as one parallelogram moves its last corner by 16 eps of G more.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_rectangle() {
  return Tier::template contract<T>(
      {.backward = 256, .unit = 8, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
