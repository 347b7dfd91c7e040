/// The nearest points of two lines.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/closest_points_lines.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The point of `line1` nearest to `line2`, and the point of `line2` nearest to it. Of parallel lines:
/// line1.point, and the point of `line2` nearest to that.
///
/// 1. point2 - point1 is at right angles to either direction
///
/// Units: lengths; the lengths of the directions play no part. Never fails. Source: the plane through line 2
/// along the common normal meets line 1 (Goldman, Intersection of Two Lines in Three-Space, Graphics Gems,
/// 1990); line 2's point is the foot of the perpendicular from there, so that the two belong together also
/// where the lines are nearly parallel.
template <class Tier = Fast, class T>
[[nodiscard]] ClosestPoints<T> closest_points_lines(const Line<T>& line1,
                                                    const Line<T>& line2) noexcept(Tier::never_throws) {
  return kernels::closest_points_lines<Tier>(line1, line2);
}

namespace contracts {

/// First order, G the largest position: the common normal carries 3 eps of |direction1| |direction2|,
/// which turning the lines by 3 eps explains; the share along line 1 carries 10 eps of the lines'
/// distance across line 2 (at most 4 G), which moving line 2 explains; its division, product and sum 3 eps,
/// a turn of both lines; the foot on line 2 another 8 eps of the way along it, a turn again.
template <class Tier = Fast, class T = double>
constexpr Contract closest_points_lines() {
  return Tier::template contract<T>({.backward = 64, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
