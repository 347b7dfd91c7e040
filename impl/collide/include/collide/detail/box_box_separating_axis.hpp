/// The kernel of box_box_separating_axis (collide/box_box_separating_axis.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/box_pair.hpp>
#include <collide/detail/box_pair_filters.hpp>
#include <collide/detail/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(box_box_separating_axis)

namespace kernels {

template <class Tier, class T>
inline Direction<T> box_box_separating_axis(const Box<T>& box1, const Box<T>& box2, int axis) {
  if constexpr (Tier::template lifts<T>) {
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_separating_axis(box1, box2, axis))
        return Tier::decided_by_filter(*answer);
    }
    return COLLIDE_LIFTED(box_box_separating_axis, box1, box2, axis);
  } else {
    if (axis < 0 || axis >= box_box_axes) {
      const T none = std::numeric_limits<T>::quiet_NaN();
      return {{none, none, none}};
    }
    if (axis >= 3 && axis < 6) return {detail::at_most_one(axes_of(box2.orientation)[axis - 3])};
    const Axes<T> axes1 = axes_of(box1.orientation);
    if (axis < 3) return {detail::at_most_one(axes1[axis])};
    const detail::BoxPair<T> pair(box1, box2);
    const int i = (axis - 6) / 3, j = (axis - 6) % 3;
    const auto cross = pair.cross_axis(i, j, false).in1;
    const T scale = pair.norm1 * pair.norm2;
    return {detail::at_most_one(axes1[(i + 1) % 3] * (cross[0] / scale) + axes1[(i + 2) % 3] * (cross[1] / scale))};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
