/// The time and place at which a moving point hits a sphere.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_sphere.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `point`, moving by `velocity` per unit of time, with `sphere`.
///
/// With `solid`, a start inside or on the surface is a contact at time 0 at the point itself; the normal points from
/// the center to the point. Without `solid`, such a start gives the exit: the last time at which the point is on the
/// surface. From outside the contact is the entry; a tangent is a hit. Zero velocity is a miss, except for a start
/// inside with `solid`.
///
/// 1. |location - center| == radius, except for a start inside with `solid`
/// 2. normal == (location - center) / |location - center|; if location == center (a solid, or radius 0) it is opposite
///    to velocity (any unit vector if that is zero)
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source: the discriminant
/// computed from the distance between the center and the line of motion (Haines, Guenther, Akenine-Moeller, Precision
/// Improvements for Ray/Sphere Intersection, 2019).
template <class Tier = Fast, class T>
[[nodiscard]] inline Impact<T> moving_point_sphere(const Vec3<T>& point, const Vec3<T>& velocity,
                                                   const Sphere<T>& sphere, bool solid) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_point_sphere, TierOfDecisions<Tier>, point, velocity, sphere, solid);
}

namespace contracts {

/// First order. The vector from center to point has an error of 2 eps of G per axis. The closest approach has an error
/// of 9 eps of that distance (at most 4 G), its square and the radius 4 eps more, the location 2 eps of 4 G.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_sphere() {
  return Tier::template contract<T>(
      {.backward = 64, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
