/// The time and place at which a moving point enters a capsule.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_capsule.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The entry of `point`, moving by `velocity` per unit of time, into the solid `capsule`.
///
/// A start strictly inside is a miss. A start on the surface is a contact at time 0 unless the point leaves, that is
/// unless normal . velocity > 0 there. From outside, touching is a hit. A capsule of radius 0 is a segment, and all its
/// points are on its surface. A capsule with p0 == p1 is a ball.
///
/// 1. location == point + velocity * time (exactly, in real numbers), at the distance radius from the axis
/// 2. normal points from the axis to location; for radius 0 it is perpendicular to the axis, with
///    normal . velocity <= 0
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source: in the plane
/// perpendicular to the axis the infinite cylinder is a circle; if the point enters the cylinder beyond an end, the
/// ball at that end decides.
template <class Tier = Fast, class T>
[[nodiscard]] inline Impact<T> moving_point_capsule(const Vec3<T>& point, const Vec3<T>& velocity,
                                                    const Capsule<T>& capsule) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_point_capsule, TierOfDecisions<Tier>, point, velocity, capsule);
}

namespace contracts {

/// First order. The axis has an error of 4 eps. The coordinate along it has an error of 8 eps of a distance of at most
/// 4 G, the rest perpendicular to it 10 eps. The closest approach has an error of 9 eps of the same distance, its
/// square and the radius 4 eps more. The position along the axis adds 9 eps of 2 G.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_capsule() {
  return Tier::template contract<T>(
      {.backward = 128, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
