/// The kernel of moving_point_span_box (collide/moving_point_span_box.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/spans.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(moving_point_span_box)

namespace kernels {

template <class Tier, class T>
inline Span<T> moving_point_span_box(const Vec3<T>& point, const Vec3<T>& velocity, const Box<T>& box) {
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(moving_point_span_box, point, velocity, box);
  } else {
    const Axes<T> axes = axes_of(box.orientation);
    const std::array<T, 3> at = into_frame<Tier>(axes, point - box.center), step = into_frame<Tier>(axes, velocity);
    const std::array<T, 3> half = components(box.half);
    Span<T> span = detail::all_times<T>();
    for (int i = 0; i < 3; ++i) detail::keep_within(span, at[i], step[i], half[i]);
    return detail::checked(span);
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
