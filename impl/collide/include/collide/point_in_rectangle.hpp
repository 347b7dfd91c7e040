/// Whether a point lies in a rectangle, both seen along an axis.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/point_in_triangle.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether `point` lies in the closed `rectangle`, the union of the triangles v0, v1, v2 and v0, v2, v3, both
/// seen along the axis of the component of `normal` of largest magnitude (of several the first).
///
/// 1. point_in_rectangle(r, n, p) == point_in_triangle({v0, v1, v2}, n, -1, p) or ({v0, v2, v3}, n, -1, p)
///
/// No point is lost on the diagonal: both triangles see it on opposite sides by the same number. Source: the
/// sides of the edges (as in Pineda, A Parallel Algorithm for Polygon Rasterization, 1988).
template <class Tier = Fast, class T>
Decision<T> point_in_rectangle(const Rectangle<T>& rectangle, const Vec3<T>& normal, const Vec3<T>& point) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return point_in_rectangle<decltype(by)>(a...); }, rectangle,
                      normal, point);
  }
  if constexpr (MachineNumber<T>) {
    if (!detail::is_finite(normal)) return {};
  }
  const int axis = detail::largest_component(normal);
  return {detail::is_inside<Tier>({rectangle.v0, rectangle.v1, rectangle.v2}, axis, point) ||
          detail::is_inside<Tier>({rectangle.v0, rectangle.v2, rectangle.v3}, axis, point)};
}

namespace contracts {

/// First order: the sides of the edges as in point_in_triangle, 33.
template <class Tier = Fast, class T = double>
constexpr Contract point_in_rectangle() {
  return Tier::template contract<T>({.backward = 33, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
