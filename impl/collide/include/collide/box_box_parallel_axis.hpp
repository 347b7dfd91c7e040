/// Which axes of two boxes are parallel.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/box_box_parallel_axis.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether an axis of box 1 and an axis of box 2 are parallel up to `epsilon`, and which. The result is the first pair,
/// in the order (0, 0), (0, 1), (0, 2), (1, 0) ... (2, 2), with
///
/// 1. |cosine of the angle between axis1 and axis2| >= 1 - epsilon
///
/// `epsilon` has no unit: 0 requires exactly parallel axes, 1 or more accepts all, less than 0 accepts none. Never
/// fails. Non-finite input: no. Source: with r the relative rotation, 1 - cosine and 1 + cosine are sums of two squares
/// of sums of r's numbers, divided by |r|^2. This separates nearly parallel axes from parallel ones; a rounded cosine
/// near 1 would not.
template <class Tier = Fast, class T>
[[nodiscard]] inline ParallelAxes<T> box_box_parallel_axis(const Box<T>& box1, const Box<T>& box2,
                                                           T epsilon) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(box_box_parallel_axis, TierOfDecisions<Tier>, box1, box2, epsilon);
}

/// The same, from the values that box_box_info computed. It is only as accurate as the cosines are.
template <class Tier = Fast, class T>
[[nodiscard]] inline ParallelAxes<T> box_box_parallel_axis(const BoxBoxInfo<T>& info,
                                                           T epsilon) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(box_box_parallel_axis, TierOfDecisions<Tier>, info, epsilon);
}

namespace contracts {

/// First order. The numbers of the relative rotation have an error of 4 eps of |q1| |q2|; rotating box 2 by 8 eps
/// accounts for it. The two sides of the comparison have errors of 4 and 5 eps of themselves; rotating by 5 eps of the
/// angle between the axes accounts for them.
template <class Tier = Fast, class T = double>
constexpr Contract box_box_parallel_axis() {
  return Tier::template contract<T>({.backward = 32, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
