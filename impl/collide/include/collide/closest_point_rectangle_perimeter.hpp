/// The point of a rectangle's perimeter nearest to a point.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/closest_point_rectangle_perimeter.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The point nearest to `point` on the edges v0 v1, v1 v2, v2 v3, v3 v0 of `rectangle`; any of them where
/// several are.
///
/// 1. the result lies on an edge, and no point of any edge is nearer
///
/// Units: lengths. Never fails. Source: the nearest point of each edge; opposite edges are compared from the
/// point, neighbours from the vertex that they share.
template <class Tier = Fast, class T>
[[nodiscard]] ClosestPoint<T> closest_point_rectangle_perimeter(const Rectangle<T>& rectangle,
                                                                const Vec3<T>& point) noexcept(Tier::never_throws) {
  return kernels::closest_point_rectangle_perimeter<Tier>(rectangle, point);
}

namespace contracts {

/// First order, G the largest position: as in closest_point_triangle_perimeter.
template <class Tier = Fast, class T = double>
constexpr Contract closest_point_rectangle_perimeter() {
  return Tier::template contract<T>({.backward = 46, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
