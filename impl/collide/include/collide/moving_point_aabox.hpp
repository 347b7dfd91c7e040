/// When and where a moving point enters an axis-aligned box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_aabox.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The entry of `point`, moving by `velocity` per unit of time, into the solid `aabox`.
///
/// A start in the closed box is a miss with `inside` set and the start as location. From outside, touching
/// counts; the normal is that of a face on which the location lies.
///
/// 1. location == point + velocity * time (exactly, in real numbers), on the surface of the box
/// 2. normal is along an axis, outward
///
/// Source: the face planes in front of the start, the last one reached (Woo, Fast Ray-Box Intersection, in
/// Graphics Gems, 1990).
template <class Tier = Fast, class T>
[[nodiscard]] Entry<T> moving_point_aabox(const Vec3<T>& point, const Vec3<T>& velocity,
                                          const AABox<T>& aabox) noexcept(Tier::never_throws) {
  return kernels::moving_point_aabox<Tier>(point, velocity, aabox);
}

namespace contracts {

/// First order, G the largest position: a gap is known to 1 eps of 2 G, the quotient adds 1 eps, product and
/// sum 1 eps each of a way of at most 2 G. Point and faces move by 4 * 2 eps G at most.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_aabox() {
  return Tier::template contract<T>(
      {.backward = 8, .unit = 0, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
