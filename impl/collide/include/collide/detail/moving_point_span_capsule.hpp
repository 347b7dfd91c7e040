/// The kernel of moving_point_span_capsule (collide/moving_point_span_capsule.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/spans.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(moving_point_span_capsule)

namespace kernels {

template <class Tier, class T>
inline Span<T> moving_point_span_capsule(const Vec3<T>& point, const Vec3<T>& velocity, const Capsule<T>& capsule) {
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(moving_point_span_capsule, point, velocity, capsule);
  } else {
    // The capsule is the union of three convex sets: the balls at its ends, and the tube between them.
    const auto in_ball_at = [&](const Vec3<T>& end) {
      Span<T> span = detail::all_times<T>();
      detail::keep_in_ball<Tier>(span, point - end, velocity, capsule.radius);
      return detail::checked(span);
    };
    const Span<T> in_balls = detail::joined(in_ball_at(capsule.p0), in_ball_at(capsule.p1));
    const Vec3<T> between = capsule.p1 - capsule.p0, from = point - capsule.p0;
    const Vec3<T> axis = unit<Tier>(between);  // zero for a ball
    const T length = Tier::dot(axis, between);
    if (!(length > T(0))) return in_balls;
    const T along = Tier::dot(axis, from), speed_along = Tier::dot(axis, velocity);
    Span<T> in_tube = detail::all_times<T>();
    detail::keep_between(in_tube, along, speed_along, T(0), length);
    detail::keep_in_ball<Tier>(in_tube, from - axis * along, velocity - axis * speed_along, capsule.radius);
    return detail::joined(in_balls, detail::checked(in_tube));
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
