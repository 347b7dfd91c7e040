/// The kernel of moving_point_span_aabox (collide/moving_point_span_aabox.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/spans.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(moving_point_span_aabox)

namespace kernels {

template <class Tier, class T>
inline Span<T> moving_point_span_aabox(const Vec3<T>& point, const Vec3<T>& velocity, const AABox<T>& aabox) {
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(moving_point_span_aabox, point, velocity, aabox);
  } else {
    const std::array<T, 3> at = components(point), step = components(velocity);
    const std::array<T, 3> low = components(aabox.min), high = components(aabox.max);
    Span<T> span = detail::all_times<T>();
    for (int i = 0; i < 3; ++i) detail::keep_between(span, at[i], step[i], low[i], high[i]);
    return detail::checked(span);
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
