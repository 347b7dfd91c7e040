/// The closest points of two lines.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/closest_points_lines.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The point of `line1` closest to `line2`, and the point of `line2` closest to it. For parallel lines point1 is
/// line1.point, and point2 is the point of `line2` closest to that. Lines that intersect meet in both points.
///
/// 1. point2 - point1 is perpendicular to both directions
///
/// Units: lengths; the lengths of the directions do not matter. Never fails. Non-finite input: unspecified points.
/// Source: the plane that contains line 2 and the common normal intersects line 1 (Goldman, Intersection of Two Lines
/// in Three-Space, Graphics Gems, 1990). The point of line 2 is the foot of the perpendicular from there, so the two
/// points belong together for nearly parallel lines too.
template <class Tier = Fast, class T>
[[nodiscard]] inline ClosestPoints<T> closest_points_lines(const Line<T>& line1,
                                                           const Line<T>& line2) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(closest_points_lines, TierOfNumbers<Tier>, line1, line2);
}

namespace contracts {

/// First order. The common normal has an error of 3 eps of |direction1| |direction2|; rotating the lines by 3 eps
/// accounts for it. The parameter along line 1 has an error of 10 eps of the distance of the lines, measured across
/// line 2 (at most 4 G); moving line 2 accounts for it. Its division, product and sum have an error of 3 eps; rotating
/// both lines accounts for it. The foot on line 2 has an error of another 8 eps of the distance along it; again a
/// rotation accounts for it.
template <class Tier = Fast, class T = double>
constexpr Contract closest_points_lines() {
  return Tier::template contract<T>({.backward = 64, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
