/// The kernel of closest_point_rectangle_perimeter (collide/closest_point_rectangle_perimeter.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/edges.hpp>
#include <collide/detail/rectangle_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(closest_point_rectangle_perimeter)

namespace kernels {

template <class Tier, class T>
inline ClosestPoint<T> closest_point_rectangle_perimeter(const Rectangle<T>& rectangle, const Vec3<T>& point) {
  if constexpr (Tier::template lifts<T>) {
#if defined(COLLIDE_LANES)
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_closest_on_perimeter(rectangle, point))
        return Tier::decided_by_filter(*answer);
    }
#endif
    return COLLIDE_LIFTED(closest_point_rectangle_perimeter, rectangle, point);
  } else {
    const std::array<Vec3<T>, 4> v{rectangle.v0, rectangle.v1, rectangle.v2, rectangle.v3};
    if constexpr (MachineNumber<T>) {
      if (const Vec3<T> all = v[0] + v[1] + v[2] + v[3] + point; !detail::is_finite(all)) return {all};
    }
    std::array<detail::EdgeFoot<T>, 4> foot;
    for (int i = 0; i < 4; ++i) foot[i] = detail::foot_on_edge<Tier>(v[i], v[(i + 1) % 4], point);
    const int edge = detail::nearest_edge<Tier>(v, foot, point);
    return {foot[edge].on(v[edge], v[(edge + 1) % 4])};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
