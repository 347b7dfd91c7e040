/// Which axes of two boxes are parallel.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/box_box_parallel_axis.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether an axis of box 1 and one of box 2 are parallel up to `epsilon`, and which: the first pair, in
/// the order (0, 0), (0, 1), (0, 2), (1, 0) ... (2, 2), of which
///
/// 1. |cosine of the angle between axis1 and axis2| >= 1 - epsilon
///
/// `epsilon` has no unit: 0 asks for exactly parallel axes, 1 or more for any, less than 0 for none. Source: with r the
/// relative rotation, 1 -+ cosine is a sum of two squares of sums of r's numbers, over |r|^2; so nearly
/// parallel axes are told from parallel ones without the rounding of a cosine near 1.
template <class Tier = Fast, class T>
[[nodiscard]] ParallelAxes<T> box_box_parallel_axis(const Box<T>& box1, const Box<T>& box2,
                                                    T epsilon) noexcept(Tier::never_throws) {
  return kernels::box_box_parallel_axis<Tier>(box1, box2, epsilon);
}

/// The same from what the tools for pairs of boxes share: as exact as the cosines are.
template <class Tier = Fast, class T>
[[nodiscard]] ParallelAxes<T> box_box_parallel_axis(const BoxBoxInfo<T>& info, T epsilon) noexcept(Tier::never_throws) {
  return kernels::box_box_parallel_axis<Tier>(info, epsilon);
}

namespace contracts {

/// First order: the numbers of the relative rotation are known to 4 eps |q1| |q2|, which turning box 2
/// by 8 eps explains; the two sides of the comparison carry 4 and 5 eps of themselves, as much as
/// turning by 5 eps of the angle in question does.
template <class Tier = Fast, class T = double>
constexpr Contract box_box_parallel_axis() {
  return Tier::template contract<T>({.backward = 32, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
