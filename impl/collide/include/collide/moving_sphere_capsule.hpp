/// The time and place at which a moving sphere hits a capsule.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_sphere_capsule.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `sphere`, moving by `velocity` per unit of time, with the solid `capsule`.
///
/// An overlap at the start is a contact at time 0. A touch at the start is a contact at time 0 unless the sphere moves
/// away. A sphere of radius 0 whose center starts strictly inside is a miss: it does not come from outside. The
/// location is the point of the capsule closest to the center at the time of contact or, for a center inside the
/// capsule, the closest point of its surface. A capsule of radius 0 is a segment; with p0 == p1 it is a ball.
///
/// 1. |center + velocity * time - location| == radius, except for an overlap at the start
/// 2. normal points from the capsule's axis to the center; for a center on the axis it is perpendicular to the axis,
///    with normal . velocity <= 0
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source: the center moves
/// as a point against a capsule with the sum of the radii. In the plane perpendicular to the axis the infinite cylinder
/// is a circle; if the center enters the cylinder beyond an end, the ball at that end decides.
template <class Tier = Fast, class T>
[[nodiscard]] inline Impact<T> moving_sphere_capsule(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                                     const Capsule<T>& capsule) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_sphere_capsule, TierOfDecisions<Tier>, sphere, velocity, capsule);
}

namespace contracts {

/// First order. The axis has an error of 4 eps. The coordinate along it has an error of 8 eps of a distance of at most
/// 4 G, the rest perpendicular to it 10 eps. The closest approach has an error of 9 eps of the same distance, its
/// square and the sum of the radii 5 eps more. The position along the axis adds 9 eps of 2 G.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_capsule() {
  return Tier::template contract<T>(
      {.backward = 128, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
