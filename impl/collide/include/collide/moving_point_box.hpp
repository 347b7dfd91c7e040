/// When and where a moving point enters a box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_box.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The entry of `point`, moving by `velocity` per unit of time, into the solid `box`.
///
/// A start strictly inside is a miss. A start on the surface is a contact at time 0 unless the point
/// leaves: unless velocity points away from every face on which it lies. From outside, touching counts.
///
/// 1. location == point + velocity * time (exactly, in real numbers), on the surface of the box
/// 2. normal is an outward normal of a face on which location lies
///
/// Source: in the box's frame, the face planes in front of the start, the last one reached (Woo, Fast
/// Ray-Box Intersection, in Graphics Gems, 1990).
template <class Tier = Fast, class T>
[[nodiscard]] Impact<T> moving_point_box(const Vec3<T>& point, const Vec3<T>& velocity,
                                         const Box<T>& box) noexcept(Tier::never_throws) {
  return kernels::moving_point_box<Tier>(point, velocity, box);
}

namespace contracts {

/// First order, G the largest position: an axis carries 16 eps (7 in each product of the quaternion, at
/// most two of them, and the sums), so a coordinate in the box frame 19 eps of the distance, which is at
/// most 4 G; the way to the face and back to the world adds 12 eps of 4 G at most.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_box() {
  return Tier::template contract<T>(
      {.backward = 128, .unit = 40, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
