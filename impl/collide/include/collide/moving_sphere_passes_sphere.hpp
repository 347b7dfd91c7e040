/// Whether a moving sphere touches a fixed one within a time.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_sphere_passes_sphere.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether `sphere`, moving by `velocity` per unit of time, touches or overlaps the solid sphere `fixed` at some time
/// from 0 to `limit`, both included. `limit` may be +infinity; a negative limit gives no. A touch counts at any time,
/// even if the sphere moves away.
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: no. Source: the least distance
/// of the centers over the path, which is a segment or a ray.
template <class Tier = Fast, class T>
[[nodiscard]] inline Decision<T> moving_sphere_passes_sphere(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                                             const Sphere<T>& fixed,
                                                             const T& limit) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_sphere_passes_sphere, TierOfDecisions<Tier>, sphere, velocity, fixed, limit);
}

namespace contracts {

/// First order. The vector between the centers has an error of 2 eps of G per axis. The closest approach has an error
/// of 9 eps of that distance (at most 4 G); the position at the limit has less. The squares have an error of 4 eps of
/// the sum of the radii.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_passes_sphere() {
  return Tier::template contract<T>({.backward = 64, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
