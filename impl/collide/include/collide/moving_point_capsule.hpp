/// When and where a moving point enters a capsule.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_capsule.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The entry of `point`, moving by `velocity` per unit of time, into the solid `capsule`.
///
/// A start strictly inside is a miss. A start on the surface is a contact at time 0 unless the point
/// leaves: unless the normal there . velocity > 0. From outside, touching counts. A capsule of radius 0 is
/// a segment, all of it surface.
///
/// 1. location == point + velocity * time (exactly, in real numbers), at the distance radius from the axis
/// 2. normal points from the axis to location; for radius 0 it is at a right angle to the axis, and not along the
/// motion
///
/// Source: in the plane across the axis the endless tube is a circle; where the point enters it beyond an
/// end, the ball around that end counts.
template <class Tier = Fast, class T>
[[nodiscard]] Impact<T> moving_point_capsule(const Vec3<T>& point, const Vec3<T>& velocity,
                                             const Capsule<T>& capsule) noexcept(Tier::never_throws) {
  return kernels::moving_point_capsule<Tier>(point, velocity, capsule);
}

namespace contracts {

/// First order, G the largest position: the axis carries 4 eps, a coordinate along it 8 eps of a distance of
/// at most 4 G, what is left beside it 10 eps; the closest approach 9 eps of the same distance, its square
/// and the radius 4 eps more; the way back along the axis 9 eps of 2 G.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_capsule() {
  return Tier::template contract<T>(
      {.backward = 128, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
