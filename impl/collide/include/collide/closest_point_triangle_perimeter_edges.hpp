/// The point of a triangle's perimeter closest to a point, and its edge, for prepared edges.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/closest_point_triangle_perimeter_edges.hpp>
#include <collide/prepared.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The point closest to `point` on the three edges of `prepared.triangle`, and the edge on which it lies: edge i runs
/// from v[i] to v[(i + 1) % 3]. If several points are equally close, the result is any of them. A vertex lies on two
/// edges; either may be returned.
///
/// 1. the point is closest_point_triangle_perimeter(triangle, point).point, or an equally close one
/// 2. the point lies on the edge
///
/// Units: lengths. Never fails. Non-finite input: a point that is not finite. Source: the closest point of each edge;
/// two edges are compared by distances measured from their common vertex.
template <class Tier = Fast, class T>
[[nodiscard]] inline EdgePoint<T> closest_point_triangle_perimeter_edges(
    const PreparedTriangleEdges<T>& prepared, const Vec3<T>& point) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(closest_point_triangle_perimeter_edges, TierOfNumbers<Tier>, prepared, point);
}

namespace contracts {

/// First order. The closest point of an edge has an error of 52 eps of G, as in closest_point_segment_unit. A
/// comparison takes two more differences, sums and a dot product, with an error of 6 eps of the distance (at most 4 G).
template <class Tier = Fast, class T = double>
constexpr Contract closest_point_triangle_perimeter_edges() {
  return Tier::template contract<T>({.backward = 76, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
