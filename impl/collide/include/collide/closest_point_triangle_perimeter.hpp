/// The point of a triangle's perimeter nearest to a point.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/closest_point_triangle_perimeter.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The point nearest to `point` on the three edges of `triangle`; any of them where several are.
///
/// 1. the result lies on an edge, and no point of any edge is nearer
///
/// Units: lengths. Never fails. Source: the nearest point of each edge; two edges are compared from the
/// vertex that they share.
template <class Tier = Fast, class T>
[[nodiscard]] ClosestPoint<T> closest_point_triangle_perimeter(const Triangle<T>& triangle,
                                                               const Vec3<T>& point) noexcept(Tier::never_throws) {
  return kernels::closest_point_triangle_perimeter<Tier>(triangle, point);
}

namespace contracts {

/// First order, G the largest position: a foot as in closest_point_segment, 22 eps G; a comparison takes
/// two more differences, sums and a dot product, 6 eps of the distance (at most 4 G), which moving the
/// further end of either edge explains.
template <class Tier = Fast, class T = double>
constexpr Contract closest_point_triangle_perimeter() {
  return Tier::template contract<T>({.backward = 46, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
