/// The kernel of closest_point_triangle_perimeter_edges (collide/closest_point_triangle_perimeter_edges.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/closest_point_triangle_perimeter.hpp>
#include <collide/detail/edges.hpp>
#include <collide/detail/frame.hpp>
#include <collide/prepared.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(closest_point_triangle_perimeter_edges)

namespace kernels {

template <class Tier, class T>
inline EdgePoint<T> closest_point_triangle_perimeter_edges(const PreparedTriangleEdges<T>& prepared,
                                                           const Vec3<T>& point) {
  if constexpr (!Tier::template computes_in<T>) {
#if defined(COLLIDE_LANES)
    if constexpr (uses_filter<Tier, T>) {
      if (const auto [edge, foot] = detail::filtered_edge(prepared.triangle, point); foot)
        return Tier::decided_by_filter(EdgePoint<T>{foot->point, edge});
    }
#endif
    return Tier::lift(
        [](auto arithmetic, const auto& t, const auto& p) {
          return kernels::closest_point_triangle_perimeter_edges<decltype(arithmetic)>(
              prepare_triangle_edges<decltype(arithmetic)>(t), p);
        },
        prepared.triangle, point);
  } else {
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
      if constexpr (!MachineNumber<T>) {  // length - length is exactly zero, whatever the error bound of the length
        if (foot[i].at_end) foot[i].from_end = Vec3<T>{};
      }
    }
    const int edge = detail::nearest_edge<Tier>(v, foot, point);
    return {foot[edge].on(v[edge], v[(edge + 1) % 3]), edge};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
