/// Whether two boxes overlap.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/box_box_overlap.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether the closed boxes meet. If not, `axis` is a separating axis: 0-2 are the axes of box 1, 3-5 those of box 2,
/// and 6 + 3 i + j is the cross product of axis i of box 1 and axis j of box 2. Touching is an overlap. Half extents of
/// 0 are allowed.
///
/// `hint` is -1 or the axis that the previous call returned. A good hint may save time. A hint does not change the
/// decision; it may change which of several separating axes is returned.
///
/// 1. box_box_overlap(a, b, h).yes() == box_box_overlap(a, b, -1).yes()
/// 2. yes() == (axis == -1)
///
/// Units: lengths. Never fails. Non-finite input: no. Source: separating axes (Gottschalk, Lin, Manocha, OBBTree,
/// 1996). The cross product of two nearly parallel edges is computed from the relative rotation of the boxes
/// (detail::BoxPair::cross_axis), so its direction stays accurate.
template <class Tier = Fast, class T>
[[nodiscard]] inline BoxOverlap<T> box_box_overlap(const Box<T>& box1, const Box<T>& box2,
                                                   int hint = -1) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(box_box_overlap, TierOfDecisions<Tier>, box1, box2, hint);
}

namespace contracts {

/// First order. A number of the relative rotation is a sum of four products, with an error of 4 eps of |q1| |q2|;
/// rotating box 2 by 8 eps accounts for it, by the same rotation for every axis. An axis (cosine or cross product) adds
/// 4 eps of its own length, and its gap 5 eps of the lengths along it. `between` has an error of 8 eps of its own
/// length, at most 4 G. In all 32 eps of G, and 24 eps of the rotations and sizes.
template <class Tier = Fast, class T = double>
constexpr Contract box_box_overlap() {
  return Tier::template contract<T>({.backward = 64, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
