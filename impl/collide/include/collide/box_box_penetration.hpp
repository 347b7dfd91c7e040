/// How deep two boxes overlap.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/box_box_penetration.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The penetration depth of two boxes: the least overlap of their projections onto the fifteen unit axes
/// (numbered as in box_box_overlap), with one contact. `hint` (-1, or the axis of last time) may speed the
/// answer up; it never changes the depth of boxes that overlap.
///
/// The normal is that axis, from box 1 to box 2. The contact lies half way between a deepest vertex and the
/// face for an axis of a box, and in the middle of the shortest segment between the two edges for a cross
/// product; where several serve, it is one of them. Apart: depth is minus the separation along `axis`, one
/// that separates the boxes, and nothing else is given. A cross product of parallel edges is no axis.
///
/// 1. depth >= 0 exactly when the closed boxes meet
/// 2. moving box 2 by depth * normal makes them touch
///
/// Source: separating axes (Gottschalk, Lin, Manocha, OBBTree, 1996); the facets of the Minkowski difference
/// of two boxes have these axes for normals, so the least overlap is the least translation that parts them.
template <class Tier = Fast, class T>
[[nodiscard]] BoxPenetration<T> box_box_penetration(const Box<T>& box1, const Box<T>& box2,
                                                    int hint = -1) noexcept(Tier::never_throws) {
  return kernels::box_box_penetration<Tier>(box1, box2, hint);
}

namespace contracts {

/// First order, G the largest position: an overlap carries what box_box_overlap's gaps do, 32 eps of G and
/// 24 eps of rotations and sizes, and 12 eps of itself, and 4 eps more where squares of overlaps were compared; a
/// vertex is the sum of three edges, known to 9 eps of them and to 9 eps of `between`, and 19 eps of 4 G on the way
/// back to the world: less than 128 eps of either. Unit: the axes are combined by a unit vector.
template <class Tier = Fast, class T = double>
constexpr Contract box_box_penetration() {
  return Tier::template contract<T>(
      {.backward = 128, .unit = 40, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
