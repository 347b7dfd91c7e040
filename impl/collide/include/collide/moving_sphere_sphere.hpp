/// The time and place at which a moving sphere hits a fixed one.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_sphere_sphere.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `sphere`, moving by `velocity` per unit of time, with the solid sphere `fixed`.
///
/// An overlap at the start is a contact at time 0. A touch at the start is a contact at time 0 unless the sphere moves
/// away. A sphere of radius 0 whose center starts strictly inside is a miss: it does not come from outside. The
/// location is the point of the fixed sphere's surface closest to the moving center at the time of contact.
///
/// 1. |location - fixed.center| == fixed.radius
/// 2. normal points from the fixed center to the moving one; if the centers coincide it is opposite to velocity (any
/// unit vector if that is zero)
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source: the center moves
/// as a point against a ball with the sum of the radii.
template <class Tier = Fast, class T>
[[nodiscard]] inline Impact<T> moving_sphere_sphere(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                                    const Sphere<T>& fixed) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_sphere_sphere, TierOfDecisions<Tier>, sphere, velocity, fixed);
}

namespace contracts {

/// First order. The vector between the centers has an error of 2 eps of G per axis. The closest approach has an error
/// of 9 eps of that distance (at most 4 G), its square and the sum of the radii 5 eps more, the location 2 eps of 4 G.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_sphere() {
  return Tier::template contract<T>(
      {.backward = 64, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
