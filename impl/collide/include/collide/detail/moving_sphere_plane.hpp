/// The kernel of moving_sphere_plane (collide/moving_sphere_plane.hpp).
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
inline Impact<T> moving_sphere_plane_in_lanes(const Sphere<T>& sphere, const Vec3<T>& velocity, const Plane<T>& plane,
                                              const Fallback& fallback) {
  using L = Lanes<T>;
  using P = Pair<T>;
  using limits = std::numeric_limits<T>;
  const L center = lanes(sphere), along = lanes(velocity), n = lanes(plane);
  const P zero = P::splat(T(0)), radius = P::splat(sphere.radius), most = P::splat(limits::max());
  const L sums = sums_of_three(n * along, n * center, n * n, n);
  const P approach = zero - first_pair(sums), height = swapped(first_pair(sums)) + P::splat(plane.offset);
  const P n2 = second_pair(sums), length = sqrt(n2), reach = radius * length;
  const P starts = height <= reach, time = and_not((height - reach) / approach, starts);
  const P down = select(starts, height / length, radius);
  const P hit = (zero <= approach) & (zero - reach <= height) & (starts | ((zero < approach) & (time <= most)));
  const L normal = n / broadcast_first(length);
  const L location = (center + along * broadcast_first(time)) - normal * broadcast_first(down);
  const P in_range = (P::splat(limits::min() / limits::epsilon()) <= n2) & (n2 <= most) & (reach <= most);
  if (!all_three(are_finite(location & broadcast_first(hit)) & broadcast_first(in_range)))
    return fallback(sphere, velocity, plane);
  return impact_where(hit, time, location, normal);
}

}  // namespace detail

#endif

namespace detail {

template <class T>
CertainDecision certain_decision(const Sphere<T>& sphere, const Vec3<T>& velocity, const Plane<T>& plane) {
  return certain_decision(in_double(sphere.center), double(sphere.radius), in_double(velocity),
                          {in_double(plane.normal), double(plane.offset)}, double(std::numeric_limits<T>::max()));
}

}  // namespace detail

COLLIDE_COMPILED(moving_sphere_plane)

namespace kernels {

template <class Tier, class T>
inline Impact<T> moving_sphere_plane(const Sphere<T>& sphere, const Vec3<T>& velocity, const Plane<T>& plane) {
  if constexpr (Tier::template lifts<T>) {
    const auto fallback = [](const auto&... inputs) { return COLLIDE_LIFTED(moving_sphere_plane, inputs...); };
#if defined(COLLIDE_LANES)
    if constexpr (in_lanes<Tier, T>) {
      return detail::moving_sphere_plane_in_lanes(sphere, velocity, plane, detail::out_of_line(fallback));
    }
#endif
    if constexpr (uses_filter<Tier, T>) {
      const auto decision = detail::certain_decision(sphere, velocity, plane);
      if (decision.decided && !decision.yes) {
        return Tier::decided_by_filter(Impact<T>::miss());
      }
      if (const auto answer = detail::filtered_contact(sphere.center, sphere.radius, velocity, plane))
        return Tier::decided_by_filter(*answer);
    }
    return fallback(sphere, velocity, plane);
  } else {
    Vec3<T> normal = plane.normal;
    T length;
    if constexpr (MachineNumber<T>) {
      normal = unit<Tier>(plane.normal), length = Tier::dot(normal, plane.normal);
    } else {  // one square root gives both; the range needs no care here
      using detail::sqrt;
      length = sqrt(Tier::dot(normal, normal));
      if (!(length == T(0))) normal = normal / length;
    }
    const T approach = -Tier::dot(plane.normal, velocity);
    const T height = Tier::dot(plane.normal, sphere.center) + plane.offset;
    const T reach = sphere.radius * length;
    if (!(approach >= T(0) && height >= -reach)) return Impact<T>::miss();
    if (height <= reach) return detail::contact(T(0), sphere.center - normal * (height / length), normal);
    if (!(approach > T(0))) return Impact<T>::miss();
    const T time = (height - reach) / approach;
    return detail::contact(time, (sphere.center + velocity * time) - normal * sphere.radius, normal);
  }
}

/// The kernel of a tier that takes numbers from another one.
template <class Tier, class T>
  requires splits_answers<Tier, T>
inline Impact<T> moving_sphere_plane(const Sphere<T>& sphere, const Vec3<T>& velocity, const Plane<T>& plane) {
  return split_answer<Tier>(
      [&](auto tier) { return kernels::moving_sphere_plane<decltype(tier)>(sphere, velocity, plane); },
      [&](const auto& answer) {
        const auto decision = detail::certain_decision(sphere, velocity, plane);
        return decision.decided && decision.yes == answer.yes();
      });
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
