/// The point of a rectangle's perimeter closest to a point.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/closest_point_rectangle_perimeter.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The point closest to `point` on the edges v0 v1, v1 v2, v2 v3, v3 v0 of `rectangle`. If several points are equally
/// close, the result is any of them. An edge of length 0 is a point.
///
/// 1. the result lies on an edge, and no point of any edge is closer
///
/// Units: lengths. Never fails. Non-finite input: a point that is not finite. Source: the closest point of each edge.
/// Opposite edges are compared by their distances from the point, adjacent edges by distances measured from their
/// common vertex.
template <class Tier = Fast, class T>
[[nodiscard]] inline ClosestPoint<T> closest_point_rectangle_perimeter(
    const Rectangle<T>& rectangle, const Vec3<T>& point) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(closest_point_rectangle_perimeter, TierOfNumbers<Tier>, rectangle, point);
}

namespace contracts {

/// First order: as in closest_point_triangle_perimeter.
template <class Tier = Fast, class T = double>
constexpr Contract closest_point_rectangle_perimeter() {
  return Tier::template contract<T>({.backward = 46, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
