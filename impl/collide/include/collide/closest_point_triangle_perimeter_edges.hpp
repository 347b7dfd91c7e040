/// The point of a triangle's perimeter nearest to a point, and its edge, with the edges' unit directions
/// and lengths at hand.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/edges.hpp>
#include <collide/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// A triangle with the unit directions (zero for a point) and lengths of its edges: made once, asked often.
template <class T>
struct TriangleEdges {
  Triangle<T> triangle{};
  std::array<Vec3<T>, 3> direction{};  ///< of edge i, from v[i] to v[(i + 1) % 3]
  std::array<T, 3> length{};
};

template <class Tier = Fast, class T>
TriangleEdges<T> prepare_edges(const Triangle<T>& triangle) noexcept {
  const std::array<Vec3<T>, 3> v = detail::corners(triangle);
  TriangleEdges<T> edges{triangle, {}, {}};
  for (int i = 0; i < 3; ++i) {
    const Vec3<T> along = v[(i + 1) % 3] - v[i];
    edges.direction[i] = unit<Tier>(along);
    edges.length[i] = length(components(along));
  }
  return edges;
}

/// The point nearest to `point` on the three edges of `prepared.triangle`, and the edge that it lies on;
/// any of them where several are. A vertex lies on two edges, and either is right.
///
/// 1. the point is closest_point_triangle_perimeter(triangle, point).point, or as near
/// 2. the point lies on the edge
///
/// Units: lengths. Never fails. Source: the nearest point of each edge; two edges are compared from the
/// vertex that they share.
template <class Tier = Fast, class T>
EdgePoint<T> closest_point_triangle_perimeter_edges(const TriangleEdges<T>& prepared, const Vec3<T>& point) noexcept {
  if constexpr (!Tier::template keeps<T>) {
    return Tier::lift(
        [](auto by, const auto& t, const auto& p) {
          return closest_point_triangle_perimeter_edges<decltype(by)>(prepare_edges<decltype(by)>(t), p);
        },
        prepared.triangle, point);
  }
  const std::array<Vec3<T>, 3> v = detail::corners(prepared.triangle);
  if constexpr (MachineNumber<T>) {
    if (const Vec3<T> all = v[0] + v[1] + v[2] + point; !detail::is_finite(all)) return {all, 0};
  }
  std::array<detail::EdgeFoot<T>, 3> foot;
  for (int i = 0; i < 3; ++i) {
    const Vec3<T>& direction = prepared.direction[i];
    const T length = prepared.length[i];
    const T projection = Tier::dot(point - v[i], direction), distance = clamped(projection, T(0), length);
    foot[i] = {direction * distance, direction * (distance - length), T(0), projection >= length};
    if constexpr (!MachineNumber<T>) {  // a length less itself is zero, however little is known of it
      if (foot[i].at_end) foot[i].from_end = Vec3<T>{};
    }
  }
  const int edge = detail::nearest_edge<Tier>(v, foot, point);
  return {foot[edge].on(v[edge], v[(edge + 1) % 3]), edge};
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
