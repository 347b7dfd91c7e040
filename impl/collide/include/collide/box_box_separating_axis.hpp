/// The candidate separating axes of two boxes.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/box_box_separating_axis.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Axis number `axis` of a pair of boxes, in world coordinates: 0-2 are the unit axes of box 1, 3-5 those of box 2, and
/// 6 + 3 i + j is the cross product of axis i of box 1 and axis j of box 2, not normalized.
///
/// 1. |direction| == 1 for axes 0..5, and the sine of the angle between the two axes for 6..14
///
/// Units: none. Never fails. All three numbers are NaN for an axis outside 0..14. Non-finite input: an unspecified
/// direction. Source: Gottschalk, Lin, Manocha, OBBTree, 1996. The cross product of nearly parallel axes is computed
/// from the relative rotation, which keeps its direction accurate.
template <class Tier = Fast, class T>
[[nodiscard]] inline Direction<T> box_box_separating_axis(const Box<T>& box1, const Box<T>& box2,
                                                          int axis) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(box_box_separating_axis, TierOfNumbers<Tier>, box1, box2, axis);
}

namespace contracts {

/// First order. An axis has an error of 16 eps; rotating its box accounts for it. A cross product has an error of 8 eps
/// from the relative rotation, 4 + 7 eps of its length, 16 eps from the axes of box 1, and 3 eps from the sum.
template <class Tier = Fast, class T = double>
constexpr Contract box_box_separating_axis() {
  return Tier::template contract<T>({.backward = 40, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
