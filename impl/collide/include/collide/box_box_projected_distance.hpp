/// The signed distance of two boxes along one of their axes.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/box_box_projected_distance.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The gap between the projections of two boxes onto axis L (0..14, see box_box_overlap), times |L|; negative where the
/// projections overlap, 0 where they touch. With D = center 2 - center 1:
///
/// 1. value == |D . L| - R1 - R2, Ri = sum over the axes k of box i of half[k] |axis k . L|
/// 2. |L| == 1 for axes 0..5, and the sine of the angle between the two axes for 6..14
///
/// Units: a length times |L|. Never fails. The value is NaN for an axis outside 0..14. Non-finite input: unspecified.
/// Source: Gottschalk, Lin, Manocha, OBBTree, 1996.
template <class Tier = Fast, class T>
[[nodiscard]] inline Measure<T> box_box_projected_distance(const Box<T>& box1, const Box<T>& box2,
                                                           int axis) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(box_box_projected_distance, TierOfNumbers<Tier>, box1, box2, axis);
}

/// The same, from the values that box_box_info computed.
template <class Tier = Fast, class T>
[[nodiscard]] inline Measure<T> box_box_projected_distance(const BoxBoxInfo<T>& info,
                                                           int axis) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(box_box_projected_distance, TierOfNumbers<Tier>, info, axis);
}

namespace contracts {

/// First order: as box_box_overlap. The division by |q1|^4 |q2|^2 adds 12 eps of the gap, for which changing the
/// lengths along the axis accounts.
template <class Tier = Fast, class T = double>
constexpr Contract box_box_projected_distance() {
  return Tier::template contract<T>({.backward = 80, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
