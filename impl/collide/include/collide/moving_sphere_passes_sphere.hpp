/// Whether a moving sphere comes to a fixed one within a time limit.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_sphere_passes_sphere.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether `sphere`, moving by `velocity` per unit of time, meets the solid sphere `fixed` at some time from 0
/// to `limit`, both included; limit may be +infinity.
///
/// Touching counts, at any time and in whatever direction the sphere moves.
///
/// Source: the least distance of the centers over the motion, a segment or a ray.
template <class Tier = Fast, class T>
[[nodiscard]] Decision<T> moving_sphere_passes_sphere(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                                      const Sphere<T>& fixed,
                                                      const T& limit) noexcept(Tier::never_throws) {
  return kernels::moving_sphere_passes_sphere<Tier>(sphere, velocity, fixed, limit);
}

namespace contracts {

/// First order, G the largest position: center to center is known to 2 eps G per axis; the closest approach
/// carries 9 eps of that distance (at most 4 G), the way to the limit less; the squares 4 eps of the sum of
/// the radii.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_passes_sphere() {
  return Tier::template contract<T>({.backward = 64, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
