/// Whether and where a ray meets an axis-aligned box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/ray_aabox.hpp>
#include <collide/prepared.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether `ray` meets the closed `aabox`, and where it enters. A ray that starts in the box meets it there.
///
/// 1. location == origin + direction * t for some t >= 0 (exactly, in real numbers), a point of the box
/// 2. inside exactly when the origin is in the box; then location == origin
///
/// The inverse saves divisions and never changes the answer. Source: the face planes in front of the origin, the
/// last one reached (Woo, Fast Ray-Box Intersection, in Graphics Gems, 1990).
template <class Tier = Fast, class T>
[[nodiscard]] RayHit<T> ray_aabox(const PreparedRay<T>& ray, const PreparedAABox<T>& box) noexcept(Tier::never_throws) {
  return kernels::ray_aabox<Tier>(ray, box);
}

namespace contracts {

/// First order, G the largest position: a gap is known to 1 eps of 2 G, inverse and product add 1 eps each,
/// product and sum 1 eps each of a way of at most 2 G. Origin and faces move by 5 * 2 eps G at most.
template <class Tier = Fast, class T = double>
constexpr Contract ray_aabox() {
  return Tier::template contract<T>({.backward = 10, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
