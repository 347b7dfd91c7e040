/// The point of a rectangle's perimeter nearest to a point.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/edges.hpp>
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
ClosestPoint<T> closest_point_rectangle_perimeter(const Rectangle<T>& rectangle, const Vec3<T>& point) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return closest_point_rectangle_perimeter<decltype(by)>(a...); },
                      rectangle, point);
  }
  const std::array<Vec3<T>, 4> v{rectangle.v0, rectangle.v1, rectangle.v2, rectangle.v3};
  if constexpr (MachineNumber<T>) {
    if (const Vec3<T> all = v[0] + v[1] + v[2] + v[3] + point; !detail::is_finite(all)) return {all};
  }
  std::array<detail::EdgeFoot<T>, 4> foot;
  for (int i = 0; i < 4; ++i) foot[i] = detail::foot_on_edge<Tier>(v[i], v[(i + 1) % 4], point);
  const int edge = detail::nearest_edge<Tier>(v, foot, point);
  return {foot[edge].on(v[edge], v[(edge + 1) % 4])};
}

namespace contracts {

/// First order, G the largest position: as in closest_point_triangle_perimeter.
template <class Tier = Fast, class T = double>
constexpr Contract closest_point_rectangle_perimeter() {
  return Tier::template contract<T>({.backward = 46, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
