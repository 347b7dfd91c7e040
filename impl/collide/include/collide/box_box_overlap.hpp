/// Whether two boxes overlap.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/box_box_overlap.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether the closed boxes meet and, where they do not, an axis that separates them: 0-2 the axes of
/// box 1, 3-5 those of box 2, 6 + 3 i + j the cross product of axis i of box 1 and axis j of box 2.
/// `hint` (-1, or the axis that separated them last time) may speed the answer up and never changes it,
/// but for which of several separating axes is named.
///
/// 1. box_box_overlap(a, b, h).yes() == box_box_overlap(a, b, -1).yes()
/// 2. yes() == (axis == -1)
///
/// Source: separating axes (Gottschalk, Lin, Manocha, OBBTree, 1996). The cross product of two nearly
/// parallel edges comes from the boxes' relative rotation (detail::BoxPair::cross_axis), so that it is a
/// direction and not what rounding leaves of one.
template <class Tier = Fast, class T>
[[nodiscard]] BoxOverlap<T> box_box_overlap(const Box<T>& box1, const Box<T>& box2,
                                            int hint = -1) noexcept(Tier::never_throws) {
  return kernels::box_box_overlap<Tier>(box1, box2, hint);
}

namespace contracts {

/// First order: a number of the relative rotation is a sum of four products, known to 4 eps |q1| |q2|,
/// which turning box 2 by 8 eps explains, the same for every axis. An axis (cosine or cross product)
/// adds 4 eps of its own length, its gap 5 eps of the lengths along it; `between` carries 8 eps of its
/// own, at most 4 G with G the largest position: 32 eps of G, 24 eps of the rotations and sizes.
template <class Tier = Fast, class T = double>
constexpr Contract box_box_overlap() {
  return Tier::template contract<T>({.backward = 64, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
