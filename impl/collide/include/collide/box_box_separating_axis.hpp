/// The axes along which two boxes may be separated.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/box_box_separating_axis.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Axis number `axis` of a pair of boxes, in the world: 0-2 the unit axes of box 1, 3-5 those of box 2,
/// 6 + 3 i + j the cross product of axis i of box 1 and axis j of box 2.
///
/// 1. |direction| == 1 for axes 0..5, and the sine of the angle between the two axes for 6..14
///
/// An axis that does not exist has NaN. Source: Gottschalk, Lin, Manocha, OBBTree, 1996; the cross product
/// of nearly parallel axes comes from the relative rotation, which keeps its direction.
template <class Tier = Fast, class T>
[[nodiscard]] Direction<T> box_box_separating_axis(const Box<T>& box1, const Box<T>& box2,
                                                   int axis) noexcept(Tier::never_throws) {
  return kernels::box_box_separating_axis<Tier>(box1, box2, axis);
}

namespace contracts {

/// First order: an axis carries 16 eps, explained by turning its box; a cross product 8 eps of the
/// relative rotation, 4 + 7 eps of its length, and the 16 eps of the axes of box 1 with 3 for the sum.
template <class Tier = Fast, class T = double>
constexpr Contract box_box_separating_axis() {
  return Tier::template contract<T>({.backward = 40, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
