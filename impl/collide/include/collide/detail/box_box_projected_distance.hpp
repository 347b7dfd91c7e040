/// The kernel of box_box_projected_distance (collide/box_box_projected_distance.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/box_box_info.hpp>
#include <collide/detail/box_pair.hpp>
#include <collide/detail/box_pair_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(box_box_projected_distance)

namespace kernels {

template <class Tier, class T>
inline Measure<T> box_box_projected_distance(const Box<T>& box1, const Box<T>& box2, int axis) {
  if constexpr (Tier::template lifts<T>) {
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_projected_distance(box1, box2, axis))
        return Tier::decided_by_filter(*answer);
    }
    return COLLIDE_LIFTED(box_box_projected_distance, box1, box2, axis);
  } else {
    if (axis < 0 || axis >= box_box_axes) return {std::numeric_limits<T>::quiet_NaN()};
    const detail::BoxPair<T> pair(box1, box2);
    // All values of the pair are multiplied by |q1|^2 |q2|^2; those that contain `between` by another |q1|^2.
    const T scale = pair.norm1 * pair.norm2;
    return {detail::separation(pair, axis, false).gap / (axis < 3 ? scale : scale * pair.norm1)};
  }
}

template <class Tier, class T>
inline Measure<T> box_box_projected_distance(const BoxBoxInfo<T>& info, int axis) {
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(box_box_projected_distance, info, axis);
  } else {
    using detail::abs;
    if (axis < 0 || axis >= box_box_axes) return {std::numeric_limits<T>::quiet_NaN()};
    const std::array<T, 3> half1 = components(info.half1), half2 = components(info.half2);
    std::array<std::array<T, 3>, 3> c;
    for (int i = 0; i < 3; ++i) c[i] = components(info.abs_cosine[i]);
    if (axis < 3) {
      const auto& row = c[axis];
      const T reach2 = half2[0] * row[0] + half2[1] * row[1] + half2[2] * row[2];
      return {abs(components(info.between1)[axis]) - (half1[axis] + reach2)};
    }
    if (axis < 6) {
      const int j = axis - 3;
      const T reach1 = half1[0] * c[0][j] + half1[1] * c[1][j] + half1[2] * c[2][j];
      return {abs(components(info.between2)[j]) - (reach1 + half2[j])};
    }
    const int i = (axis - 6) / 3, j = (axis - 6) % 3;
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    const std::array<T, 3> d = components(info.between1);
    const T distance = abs(Tier::difference_of_products(d[i2], components(info.cosine[i1])[j],  //
                                                        d[i1], components(info.cosine[i2])[j]));
    const T reach1 = half1[i1] * c[i2][j] + half1[i2] * c[i1][j];
    const T reach2 = half2[j1] * c[i][j2] + half2[j2] * c[i][j1];
    return {distance - (reach1 + reach2)};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
