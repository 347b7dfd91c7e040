/// When and where a moving sphere meets a one-sided rectangle.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_sphere_rectangle.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `sphere`, moving by `velocity` per unit of time, with `rectangle`: the earlier of
/// those with its two triangles v0, v1, v2 and v0, v2, v3, each of which is met only from its front
/// (moving_sphere_triangle). Of equally early ones it is either.
///
/// 1. |center + velocity * time - location| == radius, but for an overlap at the start
/// 2. normal points from location to the center; where the center is on the rectangle it is an outward one
///
/// Source: moving_sphere_triangle, twice.
template <class Tier = Fast, class T>
[[nodiscard]] Impact<T> moving_sphere_rectangle(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                                const Rectangle<T>& rectangle) noexcept(Tier::never_throws) {
  return kernels::moving_sphere_rectangle<Tier>(sphere, velocity, rectangle);
}

namespace contracts {

/// As moving_sphere_triangle: both triangles are explained by the same moves of the sphere's numbers, of
/// their own corners, and of the two that they share, twice as many.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_rectangle() {
  return Tier::template contract<T>(
      {.backward = 256, .unit = 8, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
