/// The point of a triangle's perimeter nearest to a point, and its edge, with the edges' unit directions
/// and lengths at hand.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/closest_point_triangle_perimeter_edges.hpp>
#include <collide/prepared.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The point nearest to `point` on the three edges of `prepared.triangle`, and the edge that it lies on;
/// any of them where several are. A vertex lies on two edges, and either is right.
///
/// 1. the point is closest_point_triangle_perimeter(triangle, point).point, or as near
/// 2. the point lies on the edge
///
/// Units: lengths. Never fails. Source: the nearest point of each edge; two edges are compared from the
/// vertex that they share.
template <class Tier = Fast, class T>
[[nodiscard]] EdgePoint<T> closest_point_triangle_perimeter_edges(const PreparedTriangleEdges<T>& prepared,
                                                                  const Vec3<T>& point) noexcept(Tier::never_throws) {
  return kernels::closest_point_triangle_perimeter_edges<Tier>(prepared, point);
}

namespace contracts {

/// First order, G the largest position: a foot as in closest_point_segment_unit, 52 eps G; a comparison
/// takes two more differences, sums and a dot product, 6 eps of the distance (at most 4 G).
template <class Tier = Fast, class T = double>
constexpr Contract closest_point_triangle_perimeter_edges() {
  return Tier::template contract<T>({.backward = 76, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
