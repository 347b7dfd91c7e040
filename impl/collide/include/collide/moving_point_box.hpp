/// The time and place at which a moving point enters a box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_box.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The entry of `point`, moving by `velocity` per unit of time, into the solid `box`.
///
/// A start strictly inside is a miss. A start on the surface is a contact at time 0 unless the point leaves, that is
/// unless velocity points away from every face on which the start lies. From outside, touching is a hit. A box with a
/// half extent of 0 has no inside.
///
/// 1. location == point + velocity * time (exactly, in real numbers), on the surface of the box
/// 2. normal is the outward unit normal of a face on which location lies
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source: in the box's
/// frame, of the face planes that the start is in front of, the one reached last (Woo, Fast Ray-Box Intersection, in
/// Graphics Gems, 1990).
template <class Tier = Fast, class T>
[[nodiscard]] inline Impact<T> moving_point_box(const Vec3<T>& point, const Vec3<T>& velocity,
                                                const Box<T>& box) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_point_box, TierOfDecisions<Tier>, point, velocity, box);
}

namespace contracts {

/// First order. An axis has an error of 16 eps (7 in each product of the quaternion, at most two of them, and the
/// sums). So a coordinate in the box's frame has an error of 19 eps of the distance, which is at most 4 G. The motion
/// to the face and the transformation to the world add at most 12 eps of 4 G.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_box() {
  return Tier::template contract<T>(
      {.backward = 128, .unit = 40, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
