/// Whether the bounding spheres of two boxes overlap: a cheap test that boxes which touch always pass.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/box_box_conservative.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether the bounding spheres of the boxes meet. With D the vector between the centers, and a, b the vectors from
/// each center to a corner of its box:
///
/// 1. yes() == (|D| <= |a| + |b|)
///
/// A no proves that the boxes are apart; a yes proves nothing. Where rounding cannot separate the two sides, the answer
/// is yes, so boxes that touch always get a yes. Units: lengths. Never fails. Non-finite input: no.
template <class Tier = Fast, class T>
[[nodiscard]] inline Decision<T> box_box_conservative(const Box<T>& box1,
                                                      const Box<T>& box2) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(box_box_conservative, TierOfDecisions<Tier>, box1, box2);
}

/// The same, from the values that box_box_info computed.
template <class Tier = Fast, class T>
[[nodiscard]] inline Decision<T> box_box_conservative(const BoxBoxInfo<T>& info) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(box_box_conservative, TierOfDecisions<Tier>, info);
}

namespace contracts {

/// First order. The computed sides have an error of 4 eps of themselves, and 8 eps are added on purpose: 12 eps of the
/// sizes, or of |D| in the positions, which is at most 4 G. That is less than 64 eps in either.
template <class Tier = Fast, class T = double>
constexpr Contract box_box_conservative() {
  return Tier::template contract<T>({.backward = 64, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
