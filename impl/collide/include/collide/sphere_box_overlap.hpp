/// Whether a sphere and a box overlap.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/sphere_box_overlap.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether the closed ball and the solid box meet. Touching is an overlap. A radius or a half extent of 0 is allowed.
///
/// 1. sphere_box_overlap(s, b) == (sphere_box_penetration(s, b).depth >= 0) in real numbers
///
/// Units: lengths. Never fails. Non-finite input: no. Source: in the box's frame the squared distance is the sum of the
/// squared excesses of each coordinate (Arvo, A Simple Method for Box-Sphere Intersection Testing, Graphics Gems,
/// 1990).
template <class Tier = Fast, class T>
[[nodiscard]] inline Decision<T> sphere_box_overlap(const Sphere<T>& sphere,
                                                    const Box<T>& box) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(sphere_box_overlap, TierOfDecisions<Tier>, sphere, box);
}

namespace contracts {

/// First order. An axis has an error of 16 eps. A coordinate in the box's frame has an error of 19 eps of the distance,
/// at most 4 G. Excess, squares, sum and the radius have 4 eps more of as much.
template <class Tier = Fast, class T = double>
constexpr Contract sphere_box_overlap() {
  return Tier::template contract<T>({.backward = 92, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
