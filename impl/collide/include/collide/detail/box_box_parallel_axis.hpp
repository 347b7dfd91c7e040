/// The kernel of box_box_parallel_axis (collide/box_box_parallel_axis.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/box_pair.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(box_box_parallel_axis)

namespace kernels {

template <class Tier, class T>
inline ParallelAxes<T> box_box_parallel_axis(const Box<T>& box1, const Box<T>& box2, T epsilon) {
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(box_box_parallel_axis, box1, box2, epsilon);
  } else {
    if (epsilon < T(0)) return {};  // accepts no pair
    const std::array<T, 4> r =
        detail::relative_rotation(detail::rescaled(box1.orientation), detail::rescaled(box2.orientation));
    const T most = epsilon * detail::norm2(r);
    if constexpr (MachineNumber<T>) {
      if (!(detail::norm2(r) > T(0))) return {};  // a zero quaternion, or NaN
    }
    if (epsilon >= T(1))
      return epsilon <= std::numeric_limits<T>::max() ? ParallelAxes<T>{true, 0, 0} : ParallelAxes<T>{};
    const auto sum = [](const T& a, const T& b) { return a * a + b * b; };
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        T from_same, from_opposite;  // |r|^2 (1 - cosine), |r|^2 (1 + cosine)
        if (i == j) {
          from_same = T(2) * sum(r[(i + 1) % 3], r[(i + 2) % 3]);
          from_opposite = T(2) * sum(r[i], r[3]);
        } else {
          const T third = j == (i + 1) % 3 ? r[3 - i - j] : -r[3 - i - j];
          from_same = sum(r[i] - r[j], r[3] + third);
          from_opposite = sum(r[i] + r[j], r[3] - third);
        }
        if (smaller(from_same, from_opposite) <= most) return {true, i, j};
      }
    }
    return {};
  }
}

template <class Tier, class T>
inline ParallelAxes<T> box_box_parallel_axis(const BoxBoxInfo<T>& info, T epsilon) {
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(box_box_parallel_axis, info, epsilon);
  } else {
    for (int i = 0; i < 3; ++i) {
      const std::array<T, 3> row = components(info.abs_cosine[i]);
      for (int j = 0; j < 3; ++j) {
        if (row[j] >= T(1) - epsilon) return {true, i, j};
      }
    }
    return {};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
