/// The time and place at which a moving sphere hits a one-sided plane.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_sphere_plane.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `sphere`, moving by `velocity` per unit of time, with the front of `plane`.
///
/// A contact requires normal . velocity <= 0, and that the sphere does not start wholly behind the plane. A sphere that
/// intersects or touches the plane at the start is a contact at time 0. A sphere in front that does not approach is a
/// miss.
///
/// 1. location is the point of the plane closest to the center at that time
/// 2. normal == plane.normal / |plane.normal|
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source: the height of
/// the center above the plane, which is linear in time.
template <class Tier = Fast, class T>
[[nodiscard]] inline Impact<T> moving_sphere_plane(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                                   const Plane<T>& plane) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_sphere_plane, Tier, sphere, velocity, plane);
}

namespace contracts {

/// First order. The computed height is that of a center whose coordinates are moved by 4 eps each, above a plane whose
/// offset is changed by 1 eps. The radius times |normal| is that of a radius changed by 7 eps, and the difference of
/// the two adds 1 eps. The computed approach speed is that of a velocity changed by 3 eps, and the quotient adds 1 eps.
/// The location adds 4 eps of the displacement and 4 eps of the radius; the displacement is at most as long as center
/// and contact together. The unit normal has an error of 4 eps, which rotates the plane.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_plane() {
  return Tier::template contract<T>(
      {.backward = 32, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
