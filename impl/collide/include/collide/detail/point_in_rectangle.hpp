/// The kernel of point_in_rectangle (collide/point_in_rectangle.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/point_in_triangle.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace kernels {

template <class Tier, class T>
inline Decision<T> point_in_rectangle(const Rectangle<T>& rectangle, const Vec3<T>& normal, const Vec3<T>& point) {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift(
        [](auto arithmetic, const auto&... a) { return kernels::point_in_rectangle<decltype(arithmetic)>(a...); },
        rectangle, normal, point);
  } else {
    if constexpr (MachineNumber<T>) {
      if (!detail::is_finite(normal)) return {};
    }
    const int axis = detail::largest_component(normal);
    return {detail::is_inside<Tier>({rectangle.v0, rectangle.v1, rectangle.v2}, axis, point) ||
            detail::is_inside<Tier>({rectangle.v0, rectangle.v2, rectangle.v3}, axis, point)};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
