/// Whether two boxes overlap.
#pragma once

#include <collide/answers.hpp>
#include <collide/box_pair.hpp>
#include <collide/contract.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether the closed boxes meet and, where they do not, an axis that separates them: 0-2 the axes of
/// box 1, 3-5 those of box 2, 6 + 3 i + j the cross product of axis i of box 1 and axis j of box 2.
/// `hint` (-1, or the axis that separated them last time) may speed the answer up and never changes it,
/// but for which of several separating axes is named.
///
/// 1. box_box_overlap(a, b, h).overlap == box_box_overlap(a, b, -1).overlap
/// 2. overlap == (axis == -1)
///
/// Source: separating axes (Gottschalk, Lin, Manocha, OBBTree, 1996). The cross product of two nearly
/// parallel edges comes from the boxes' relative rotation (detail::BoxPair::cross_axis), so that it is a
/// direction and not what rounding leaves of one.
template <class Tier = Fast, class T>
BoxOverlap<T> box_box_overlap(const Box<T>& box1, const Box<T>& box2, int hint = -1) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return box_box_overlap<decltype(by)>(a...); }, box1, box2, hint);
  }
  const detail::BoxPair<T> pair(box1, box2);
  if constexpr (MachineNumber<T>) {
    if (!(pair.norm1 * pair.norm2 > T(0))) return {};  // no rotation, or NaN
  }
  const auto separates = [&](int axis) {  // so does NaN: it must not look like an overlap
    return !(detail::separation(pair, axis).gap <= T(0));
  };
  if (hint >= 0 && hint < box_box_axes && separates(hint)) return {false, hint};
  for (int axis = 0; axis < box_box_axes; ++axis) {
    if (separates(axis)) return {false, axis};
  }
  return {true, -1};
}

namespace inputs {
template <class T>
struct box_box_overlap {
  Box<T> box1{}, box2{};
  int hint = -1;

  static constexpr auto members() {
    return std::tuple(member("box1", &box_box_overlap::box1), member("box2", &box_box_overlap::box2),
                      member("hint", &box_box_overlap::hint, Role::index));
  }
  template <class Tier>
  auto ask() const noexcept {
    return collide::box_box_overlap<Tier>(box1, box2, hint);
  }

  /// First order: a number of the relative rotation is a sum of four products, known to 4 eps |q1| |q2|,
  /// which turning box 2 by 8 eps explains, the same for every axis. An axis (cosine or cross product)
  /// adds 4 eps of its own length, its gap 5 eps of the lengths along it; `between` carries 8 eps of its
  /// own, at most 4 G with G the largest position: 32 eps of G, 24 eps of the rotations and sizes.
  static constexpr Contract contract(Fast) {
    return {.backward = 64, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)};
  }
};
}  // namespace inputs
}  // namespace collide
