/// Whether two boxes may overlap, from their bounding spheres.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/box_box_conservative.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether the boxes' bounding spheres meet: with D the vector between the centers and a, b those from
/// each center to a corner,
///
/// 1. yes() == (|D| <= |a| + |b|)
///
/// Boxes that touch always get a yes: where the two sides are as near as rounding, so is the answer.
template <class Tier = Fast, class T>
[[nodiscard]] Decision<T> box_box_conservative(const Box<T>& box1, const Box<T>& box2) noexcept(Tier::never_throws) {
  return kernels::box_box_conservative<Tier>(box1, box2);
}

/// The same from what the tools for pairs of boxes share.
template <class Tier = Fast, class T>
[[nodiscard]] Decision<T> box_box_conservative(const BoxBoxInfo<T>& info) noexcept(Tier::never_throws) {
  return kernels::box_box_conservative<Tier>(info);
}

namespace contracts {

/// First order: the two sides differ by 4 eps of themselves, and 8 eps are added on purpose: 12 eps of
/// the sizes, or of |D| in the positions, at most 4 G with G the largest: less than 64 in either.
template <class Tier = Fast, class T = double>
constexpr Contract box_box_conservative() {
  return Tier::template contract<T>({.backward = 64, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
