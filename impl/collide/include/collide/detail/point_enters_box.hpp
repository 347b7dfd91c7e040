/// The entry of a moving point, or of a sphere of radius 0, into a box. Used by the queries about moving points and
/// spheres.
#pragma once

#include <limits>

#include <collide/answers.hpp>
#include <collide/detail/enter_box.hpp>
#include <collide/detail/frame.hpp>
#include <collide/shapes.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// The kernel of moving_point_box.
template <class Tier, class T>
inline Impact<T> point_enters_box(const Vec3<T>& point, const Vec3<T>& velocity, const Box<T>& box) {
  using detail::abs;
  const Axes<T> axes = axes_of(box.orientation);
  const std::array<T, 3> half = components(box.half), low = components(-box.half);
  const std::array<T, 3> at = into_frame<Tier>(axes, point - box.center), step = into_frame<Tier>(axes, velocity);
  const auto contact = [&](const T& time, const std::array<T, 3>& where, int axis, const T& side) -> Impact<T> {
    if (!(time <= std::numeric_limits<T>::max())) return Impact<T>::miss();
    return {time, box.center + out_of_frame(axes, where), axes[axis] * side};
  };
  bool outside = false;
  for (int i = 0; i < 3; ++i) outside = outside || abs(at[i]) > half[i];
  if (!outside) {
    for (int i = 0; i < 3; ++i) {
      if (at[i] == half[i] && step[i] <= T(0)) return contact(T(0), at, i, T(1));
      if (at[i] == low[i] && step[i] >= T(0)) return contact(T(0), at, i, T(-1));
    }
    return Impact<T>::miss();
  }
  const auto entry = enter_box(at, step, low, half, [&](const T& gap, int i) -> T { return gap / step[i]; });
  if (entry.axis < 0) return Impact<T>::miss();
  return contact(entry.time, entry.at, entry.axis, entry.side);
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
