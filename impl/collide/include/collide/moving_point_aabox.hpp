/// The time and place at which a moving point enters an axis-aligned box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_aabox.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The entry of `point`, moving by `velocity` per unit of time, into the solid `aabox`.
///
/// A start in the closed box is a miss with `inside` set and the start as the location. From outside, touching is a
/// hit. The normal is that of a face on which the location lies. Zero velocity outside is a miss. A box with min == max
/// in a coordinate is a rectangle, a segment or a point.
///
/// 1. location == point + velocity * time (exactly, in real numbers), on the surface of the box
/// 2. normal is the outward unit vector along a coordinate axis
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source: of the face
/// planes that the start is in front of, the one reached last (Woo, Fast Ray-Box Intersection, in Graphics Gems, 1990).
template <class Tier = Fast, class T>
[[nodiscard]] inline Entry<T> moving_point_aabox(const Vec3<T>& point, const Vec3<T>& velocity,
                                                 const AABox<T>& aabox) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_point_aabox, Tier, point, velocity, aabox);
}

namespace contracts {

/// First order. A gap has an error of 1 eps of 2 G. The quotient adds 1 eps, product and sum 1 eps each, of a
/// displacement of at most 2 G. Moving the point and the faces by at most 4 * 2 eps of G accounts for all.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_aabox() {
  return Tier::template contract<T>(
      {.backward = 8, .unit = 0, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
