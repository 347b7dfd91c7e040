/// The point of a triangle's perimeter closest to a point.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/closest_point_triangle_perimeter.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The point closest to `point` on the three edges of `triangle`. If several points are equally close, the result is
/// any of them. A triangle without area is a segment or a point.
///
/// 1. the result lies on an edge, and no point of any edge is closer
///
/// Units: lengths. Never fails. Non-finite input: a point that is not finite. Source: the closest point of each edge;
/// two edges are compared by distances measured from their common vertex.
template <class Tier = Fast, class T>
[[nodiscard]] inline ClosestPoint<T> closest_point_triangle_perimeter(
    const Triangle<T>& triangle, const Vec3<T>& point) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(closest_point_triangle_perimeter, TierOfNumbers<Tier>, triangle, point);
}

namespace contracts {

/// First order. The closest point of an edge has an error of 22 eps of G, as in closest_point_segment. A comparison
/// takes two more differences, sums and a dot product. They have an error of 6 eps of the distance (at most 4 G), for
/// which moving the farther end of either edge accounts.
template <class Tier = Fast, class T = double>
constexpr Contract closest_point_triangle_perimeter() {
  return Tier::template contract<T>({.backward = 46, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
