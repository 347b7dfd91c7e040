/// The values that several queries about a pair of boxes share.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/box_box_info.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The half extents of two boxes, the vector between their centers (in the world and in each frame), and the cosines of
/// the angles between their axes. Computed once for a pair, it serves box_box_projected_distance, box_box_parallel_axis
/// and box_box_conservative.
///
/// 1. cosine[i][j] == (axis i of box 1) . (axis j of box 2), abs_cosine[i][j] its absolute value
/// 2. between == center 2 - center 1; between1[i] and between2[i] are its components along axis i
///
/// Units: lengths; cosines have none. Never fails. Non-finite input: unspecified numbers. Source: the terms that all
/// separating-axis tests of two boxes share (Gottschalk, Lin, Manocha, OBBTree, 1996); the cosines are the matrix of
/// the relative rotation.
template <class Tier = Fast, class T>
[[nodiscard]] inline BoxBoxInfo<T> box_box_info(const Box<T>& box1, const Box<T>& box2) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(box_box_info, TierOfNumbers<Tier>, box1, box2);
}

namespace contracts {

/// First order. A number of the relative rotation has an error of 4 eps of |q1| |q2|. A cosine adds 3 eps, and its
/// divisor 7 eps. Rotating a box by 16 eps accounts for both. An axis has an error of 16 eps, so a component of
/// `between` has an error of 19 eps of its length, at most 4 G; `between` itself has an error of 1 eps.
template <class Tier = Fast, class T = double>
constexpr Contract box_box_info() {
  return Tier::template contract<T>({.backward = 80, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
