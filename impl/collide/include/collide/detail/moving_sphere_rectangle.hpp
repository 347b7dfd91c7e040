/// The kernel of moving_sphere_rectangle (collide/moving_sphere_rectangle.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/moving_sphere_triangle.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(moving_sphere_rectangle)

namespace kernels {

template <class Tier, class T>
inline Impact<T> moving_sphere_rectangle(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                         const Rectangle<T>& rectangle) {
  if constexpr (Tier::template lifts<T>) {
    const auto fallback = [](const auto&... inputs) { return COLLIDE_LIFTED(moving_sphere_rectangle, inputs...); };
#if defined(COLLIDE_LANES)
    if constexpr (in_lanes<Tier, T>) {
      using detail::lanes;
      const auto first = lanes(rectangle.v0);
      return detail::moving_sphere_polygon_in_lanes<Impact<T>, 4>(
          sphere, velocity,
          detail::CornersInLanes<T, 4>{first, lanes(rectangle.v1), lanes(rectangle.v2), lanes(rectangle.v3), first},
          [&]() COLLIDE_COLD { return fallback(sphere, velocity, rectangle); });
    }
#endif
    return fallback(sphere, velocity, rectangle);
  } else {
    const TriangleImpact<T> one =
        kernels::moving_sphere_triangle<Tier>(sphere, velocity, Triangle<T>{rectangle.v0, rectangle.v1, rectangle.v2});
    const TriangleImpact<T> two =
        kernels::moving_sphere_triangle<Tier>(sphere, velocity, Triangle<T>{rectangle.v0, rectangle.v2, rectangle.v3});
    // On the diagonal both triangles are hit at the same time.
    const bool both = one.yes() && two.yes() && one.weights.y == T(0) && two.weights.z == T(0);
    const TriangleImpact<T>& first = !both && two.time < one.time ? two : one;
    return {first.time, first.location, first.normal};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
