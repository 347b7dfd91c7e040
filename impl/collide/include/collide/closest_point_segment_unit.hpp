/// The point of a segment closest to a point, for a prepared segment.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/closest_point_segment_unit.hpp>
#include <collide/prepared.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The point of `prepared.segment` closest to `point`. Preparation saves a division and does not change the result:
///
/// 1. closest_point_segment_unit(prepare_segment(s), p) == closest_point_segment(s, p) in real numbers
///
/// Units: lengths. Never fails. Non-finite input: an unspecified point. Source: orthogonal projection onto the line,
/// clamped to the segment.
template <class Tier = Fast, class T>
[[nodiscard]] inline ClosestPoint<T> closest_point_segment_unit(const PreparedSegment<T>& prepared,
                                                                const Vec3<T>& point) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(closest_point_segment_unit, TierOfNumbers<Tier>, prepared, point);
}

namespace contracts {

/// First order. Two differences have an error of 1 eps of 2 G each. The unit vector and the length have an error of
/// 4 eps each, of the segment's 4 G. The dot product has an error of 3 eps of |point - v0|, at most 4 G. Product and
/// sum have an error of 1 eps of at most 2 G each. Moving the point and the ends by 2 * 2 + 2 * 4 * 4 + 3 * 4 + 2 * 2 =
/// 52 eps of G accounts for all.
template <class Tier = Fast, class T = double>
constexpr Contract closest_point_segment_unit() {
  return Tier::template contract<T>({.backward = 52, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
