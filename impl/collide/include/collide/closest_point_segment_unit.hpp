/// The point of a segment nearest to a point, with the segment's unit direction and length at hand.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/closest_point_segment_unit.hpp>
#include <collide/prepared.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The point of `prepared.segment` nearest to `point`. The helps save a division and never change the
/// meaning: closest_point_segment_unit(prepare_segment(s), p) is closest_point_segment(s, p) in real numbers.
///
/// Units: lengths. Never fails. Source: orthogonal projection, clamped to the segment.
template <class Tier = Fast, class T>
[[nodiscard]] ClosestPoint<T> closest_point_segment_unit(const PreparedSegment<T>& prepared,
                                                         const Vec3<T>& point) noexcept(Tier::never_throws) {
  return kernels::closest_point_segment_unit<Tier>(prepared, point);
}

namespace contracts {

/// First order, G the largest position: two differences (1 eps of 2 G each), a unit vector and a length
/// (4 eps each, of the segment's 4 G), a dot product (3 eps of |point - v0|, at most 4 G), product and sum
/// (1 eps of at most 2 G each): 2 * 2 + 2 * 4 * 4 + 3 * 4 + 2 * 2 eps G, which moving the point and the
/// ends explains.
template <class Tier = Fast, class T = double>
constexpr Contract closest_point_segment_unit() {
  return Tier::template contract<T>({.backward = 52, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
