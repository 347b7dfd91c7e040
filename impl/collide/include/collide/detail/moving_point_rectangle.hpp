/// The kernel of moving_point_rectangle (collide/moving_point_rectangle.hpp).
#pragma once

#include <optional>

#include <collide/detail/moving_point_triangle.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/detail/wide_lanes.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

#if defined(COLLIDE_LANES)

namespace detail {

/// Filter: the certain answer for the two triangles of a rectangle, or nullopt.
template <class T>
std::optional<Impact<T>> filtered_impact(const Vec3<T>& point, const Vec3<T>& velocity, const Rectangle<T>& rectangle) {
  using L = Lanes<double>;
  const L from = wide_lanes(point), along = wide_lanes(velocity);
  const L a = wide_lanes(rectangle.v0) - from, b = wide_lanes(rectangle.v1) - from, c = wide_lanes(rectangle.v2) - from,
          d = wide_lanes(rectangle.v3) - from;
  const CertainPassage first = certain_passage(along, a, b, c);
  const bool finite = all_finite(rectangle);  // a corner that a triangle does not have
  if (first.within && finite)
    return filtered_contact(point, velocity, Triangle<T>{rectangle.v0, rectangle.v1, rectangle.v2});
  const CertainPassage second = certain_passage(along, a, c, d);
  if (second.within && finite)
    return filtered_contact(point, velocity, Triangle<T>{rectangle.v0, rectangle.v2, rectangle.v3});
  if (first.beside && second.beside) return Impact<T>::miss();
  return std::nullopt;
}

}  // namespace detail

#endif

COLLIDE_COMPILED(moving_point_rectangle)

namespace kernels {

template <class Tier, class T>
inline Impact<T> moving_point_rectangle(const Vec3<T>& point, const Vec3<T>& velocity, const Rectangle<T>& rectangle) {
  if constexpr (Tier::template lifts<T>) {
#if defined(COLLIDE_LANES)
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_impact(point, velocity, rectangle))
        return Tier::decided_by_filter(*answer);
    }
#endif
    return COLLIDE_LIFTED(moving_point_rectangle, point, velocity, rectangle);
  } else {
    const Vec3<T> a = rectangle.v0 - point, b = rectangle.v1 - point;
    const Vec3<T> c = rectangle.v2 - point, d = rectangle.v3 - point;
    const Vec3<T> diagonal = rectangle.v2 - rectangle.v0;
    const T beside = Tier::dot(velocity, Tier::cross(c, a));  // side of the diagonal: negative on the side of v1
    T time = std::numeric_limits<T>::infinity();
    Vec3<T> normal{};
    const auto meet = [&](const Vec3<T>& edge1, const Vec3<T>& edge2) {
      const Vec3<T> n = detail::normal_of<Tier>(edge1, edge2);
      const T approach = -Tier::dot(n, velocity), behind = Tier::dot(n, a);
      if (!(approach > T(0) && behind <= T(0))) return;
      const T at = detail::time_in_triangle<Tier>(T(-behind / approach), velocity, n, a, edge1, edge2);
      if (at >= T(0) && at < time) time = at, normal = n;
    };
    if (beside <= T(0) && Tier::dot(velocity, Tier::cross(a, b)) <= T(0) &&
        Tier::dot(velocity, Tier::cross(b, c)) <= T(0)) {
      meet(rectangle.v1 - rectangle.v0, diagonal);
    }
    if (beside >= T(0) && Tier::dot(velocity, Tier::cross(c, d)) <= T(0) &&
        Tier::dot(velocity, Tier::cross(d, a)) <= T(0)) {
      meet(diagonal, rectangle.v3 - rectangle.v0);
    }
    if (!(time <= std::numeric_limits<T>::max())) return Impact<T>::miss();
    return detail::contact(time, point + velocity * time, unit<Tier>(normal));
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
