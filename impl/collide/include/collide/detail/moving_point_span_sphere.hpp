/// The kernel of moving_point_span_sphere (collide/moving_point_span_sphere.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/spans.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(moving_point_span_sphere)

namespace kernels {

template <class Tier, class T>
inline Span<T> moving_point_span_sphere(const Vec3<T>& point, const Vec3<T>& velocity, const Sphere<T>& sphere) {
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(moving_point_span_sphere, point, velocity, sphere);
  } else {
    Span<T> span = detail::all_times<T>();
    detail::keep_in_ball<Tier>(span, point - sphere.center, velocity, sphere.radius);
    return detail::checked(span);
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
