/// Whether and where a ray hits an axis-aligned box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/ray_aabox.hpp>
#include <collide/prepared.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether `ray` hits the closed `aabox`, and where it enters. Ray and box are prepared: prepare_ray(ray),
/// prepare_aabox(aabox). A ray that starts in the box hits it at its origin. Touching is a hit.
///
/// 1. location == origin + direction * t for some t >= 0 (exactly, in real numbers), a point of the box
/// 2. inside exactly when the origin is in the box; then location == origin
///
/// Preparation saves divisions and does not change the answer. Units: lengths; the length of the direction does not
/// matter. Never fails. Non-finite input: a miss. Source: of the face planes that the origin is in front of, the one
/// reached last (Woo, Fast Ray-Box Intersection, in Graphics Gems, 1990).
template <class Tier = Fast, class T>
[[nodiscard]] inline RayHit<T> ray_aabox(const PreparedRay<T>& ray,
                                         const PreparedAABox<T>& box) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(ray_aabox, Tier, ray, box);
}

namespace contracts {

/// First order. A gap has an error of 1 eps of 2 G. Inverse and product add 1 eps each; product and sum of the location
/// add 1 eps each of a displacement of at most 2 G. Moving the origin and the faces by at most 5 * 2 eps of G accounts
/// for all.
template <class Tier = Fast, class T = double>
constexpr Contract ray_aabox() {
  return Tier::template contract<T>({.backward = 10, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
