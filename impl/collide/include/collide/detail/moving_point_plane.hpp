/// The kernel of moving_point_plane (collide/moving_point_plane.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/contact.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

#if defined(COLLIDE_LANES)

namespace detail {

/// The kernel of `Fast` in lanes. Calls `fallback` if the length of the normal is extreme or the contact is not finite.
template <class T, class Fallback>
inline Impact<T> moving_point_plane_in_lanes(const Vec3<T>& point, const Vec3<T>& velocity, const Plane<T>& plane,
                                             const Fallback& fallback) {
  using L = Lanes<T>;
  using P = Pair<T>;
  using limits = std::numeric_limits<T>;
  const L from = lanes(point), along = lanes(velocity), n = lanes(plane);
  const P zero = P::splat(T(0));
  const L sums = sums_of_three(n * along, n * from, n * n, n);
  const P approach = zero - first_pair(sums), height = swapped(first_pair(sums)) + P::splat(plane.offset);
  const P n2 = second_pair(sums), time = height / approach;
  const L location = from + along * broadcast_first(time);
  const P hit = (zero < approach) & (zero <= height) & (time <= P::splat(limits::max()));
  const P in_range = (P::splat(limits::min() / limits::epsilon()) <= n2) & (n2 <= P::splat(limits::max()));
  if (!all_three(are_finite(location & broadcast_first(hit)) & broadcast_first(in_range)))
    return fallback(point, velocity, plane);
  return impact_where(hit, time, location, n / broadcast_first(sqrt(n2)));
}

}  // namespace detail

#endif

namespace detail {

template <class T>
CertainDecision certain_decision(const Vec3<T>& point, const Vec3<T>& velocity, const Plane<T>& plane) {
  return certain_decision(in_double(point), 0.0, in_double(velocity), {in_double(plane.normal), double(plane.offset)},
                          double(std::numeric_limits<T>::max()));
}

}  // namespace detail

COLLIDE_COMPILED(moving_point_plane)

namespace kernels {

template <class Tier, class T>
inline Impact<T> moving_point_plane(const Vec3<T>& point, const Vec3<T>& velocity, const Plane<T>& plane) {
  if constexpr (Tier::template lifts<T>) {
    const auto fallback = [](const auto&... inputs) { return COLLIDE_LIFTED(moving_point_plane, inputs...); };
#if defined(COLLIDE_LANES)
    if constexpr (in_lanes<Tier, T>) {
      return detail::moving_point_plane_in_lanes(point, velocity, plane, detail::out_of_line(fallback));
    }
#endif
    if constexpr (uses_filter<Tier, T>) {
      const auto decision = detail::certain_decision(point, velocity, plane);
      if (decision.decided && !decision.yes) {
        return Tier::decided_by_filter(Impact<T>::miss());
      }
      if (const auto answer = detail::filtered_contact(point, T(0), velocity, plane))
        return Tier::decided_by_filter(*answer);
    }
    return fallback(point, velocity, plane);
  } else {
    const T approach = -Tier::dot(plane.normal, velocity);
    if (!(approach > T(0))) return Impact<T>::miss();
    const T height = Tier::dot(plane.normal, point) + plane.offset;
    if (!(height >= T(0))) return Impact<T>::miss();
    const T time = height / approach;
    return detail::contact(time, point + velocity * time, unit<Tier>(plane.normal));
  }
}

/// The kernel of a tier that takes numbers from another one.
template <class Tier, class T>
  requires splits_answers<Tier, T>
inline Impact<T> moving_point_plane(const Vec3<T>& point, const Vec3<T>& velocity, const Plane<T>& plane) {
  return split_answer<Tier>(
      [&](auto tier) { return kernels::moving_point_plane<decltype(tier)>(point, velocity, plane); },
      [&](const auto& answer) {
        const auto decision = detail::certain_decision(point, velocity, plane);
        return decision.decided && decision.yes == answer.yes();
      });
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
