/// The penetration depth of two boxes.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/box_box_penetration.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The penetration depth of two boxes: the least overlap of their projections onto the fifteen unit axes (numbered as
/// in box_box_overlap), with one contact. Touching boxes have depth 0.
///
/// The normal is the axis of least overlap, directed from box 1 to box 2. For an axis of a box, the contact lies half
/// way between a deepest vertex of the other box and the face. For a cross product, it is the midpoint of the shortest
/// segment between the two edges. If several axes, vertices or edges qualify, the result uses any of them. For boxes
/// that are apart, depth is minus the separation along `axis`, which is any separating axis, and normal and contact are
/// zero. The cross product of parallel edges is not an axis.
///
/// `hint` is -1 or the axis that the previous call returned. A good hint may save time. It does not change the depth of
/// boxes that overlap.
///
/// 1. depth >= 0 exactly when the closed boxes meet
/// 2. moving box 2 by depth * normal makes them touch
///
/// Units: lengths. Never fails. Non-finite input: a depth of NaN. Source: separating axes (Gottschalk, Lin, Manocha,
/// OBBTree, 1996). The facets of the Minkowski difference of two boxes have these axes as normals, so the least overlap
/// is the shortest translation that separates the boxes.
template <class Tier = Fast, class T>
[[nodiscard]] inline BoxPenetration<T> box_box_penetration(const Box<T>& box1, const Box<T>& box2,
                                                           int hint = -1) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(box_box_penetration, Tier, box1, box2, hint);
}

namespace contracts {

/// First order. An overlap has the errors of box_box_overlap's gaps, 32 eps of G and 24 eps of rotations and sizes, and
/// 12 eps of itself. Where squares of overlaps were compared it has 4 eps more. A vertex is the sum of three edges,
/// with an error of 9 eps of these and 9 eps of `between`; the transformation to the world adds 19 eps of 4 G. All are
/// less than 128 eps. Unit: the axes are combined with the components of a unit vector.
template <class Tier = Fast, class T = double>
constexpr Contract box_box_penetration() {
  return Tier::template contract<T>(
      {.backward = 128, .unit = 40, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
