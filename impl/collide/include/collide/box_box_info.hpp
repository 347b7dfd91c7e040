/// What the tools for pairs of boxes share.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/box_box_info.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The half extents of two boxes, the vector between their centers in the world and in each frame, and
/// the cosines of the angles between their axes: computed once for a pair, for box_box_projected_distance,
/// box_box_parallel_axis and box_box_conservative.
///
/// 1. cosine[i][j] == (axis i of box 1) . (axis j of box 2), abs_cosine[i][j] its absolute value
/// 2. between == center 2 - center 1; between1[i] and between2[i] are its parts along axis i
///
/// Lengths are in the unit of the boxes. Source: the numbers that every separating axis test of two boxes
/// shares (Gottschalk, Lin, Manocha, OBBTree, 1996); the cosines are those of the relative rotation.
template <class Tier = Fast, class T>
[[nodiscard]] BoxBoxInfo<T> box_box_info(const Box<T>& box1, const Box<T>& box2) noexcept(Tier::never_throws) {
  return kernels::box_box_info<Tier>(box1, box2);
}

namespace contracts {

/// First order, G the largest position: a number of the relative rotation is known to 4 eps |q1| |q2|,
/// a cosine to 3 eps more and the 7 eps of its divisor: turning a box by 16 eps explains both. An axis
/// carries 16 eps, so a part of `between` 19 eps of its length, at most 4 G; `between` itself 1 eps of it.
template <class Tier = Fast, class T = double>
constexpr Contract box_box_info() {
  return Tier::template contract<T>({.backward = 80, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
