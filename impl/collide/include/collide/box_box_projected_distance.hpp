/// How far two boxes lie apart along one of their axes.
#pragma once

#include <collide/answers.hpp>
#include <collide/box_box_info.hpp>
#include <collide/box_pair.hpp>
#include <collide/contract.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The gap between the projections of two boxes onto axis L (0..14, see box_box_overlap), times |L|;
/// negative where they overlap. With D = center 2 - center 1:
///
/// 1. value == |D . L| - R1 - R2, Ri = sum over the axes k of box i of half[k] |axis k . L|
/// 2. |L| == 1 for axes 0..5 and the sine of the angle between the two axes for 6..14
///
/// A length times |L|. An axis that does not exist has NaN. Source: Gottschalk, Lin, Manocha, OBBTree, 1996.
template <class Tier = Fast, class T>
Measure<T> box_box_projected_distance(const Box<T>& box1, const Box<T>& box2, int axis) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return box_box_projected_distance<decltype(by)>(a...); }, box1,
                      box2, axis);
  }
  if (axis < 0 || axis >= box_box_axes) return {std::numeric_limits<T>::quiet_NaN()};
  const detail::BoxPair<T> pair(box1, box2);
  // Every number of the pair is multiplied by |q1|^2 |q2|^2, those with a part of `between` by |q1|^2 more.
  const T scale = pair.norm1 * pair.norm2;
  return {detail::separation(pair, axis, false).gap / (axis < 3 ? scale : scale * pair.norm1)};
}

/// The same from what the tools for pairs of boxes share.
template <class Tier = Fast, class T>
Measure<T> box_box_projected_distance(const BoxBoxInfo<T>& info, int axis) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return box_box_projected_distance<decltype(by)>(a...); }, info,
                      axis);
  }
  using std::abs;
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

namespace contracts {

/// First order: as box_box_overlap, and the division by |q1|^4 |q2|^2 with 12 eps of the gap, which the
/// lengths along the axis explain.
template <class Tier = Fast, class T = double>
constexpr Contract box_box_projected_distance() {
  return Tier::template contract<T>({.backward = 80, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
