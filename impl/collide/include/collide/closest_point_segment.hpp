/// The point of a segment closest to a point.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/closest_point_segment.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The point of `segment` closest to `point`. A segment of length 0 is a point.
///
/// 1. closest_point_segment(s, s.v0).point == s.v0, and the same for s.v1
/// 2. the distance to the result is not larger than the distance to either end
///
/// Units: lengths. Never fails. Non-finite input: an unspecified point. Source: orthogonal projection onto the line,
/// clamped to the segment.
template <class Tier = Fast, class T>
[[nodiscard]] inline ClosestPoint<T> closest_point_segment(const Segment<T>& segment,
                                                           const Vec3<T>& point) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(closest_point_segment, TierOfNumbers<Tier>, segment, point);
}

namespace contracts {

/// First order. Two differences have an error of 1 eps of 2 G each. With d = point - v0, the dot product has an error
/// of 3 eps of |d| |along|, which is 12 eps of G along the segment after the division. Division, product and sum have
/// an error of 1 eps of at most 2 G each. Moving the point and the ends by 2 * 2 + 12 + 3 * 2 = 22 eps of G accounts
/// for all.
template <class Tier = Fast, class T = double>
constexpr Contract closest_point_segment() {
  return Tier::template contract<T>({.backward = 22, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
