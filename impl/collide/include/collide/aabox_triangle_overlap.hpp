/// Whether an axis-aligned box and a triangle overlap.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/aabox_triangle_overlap.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether the closed axis-aligned box and the closed triangle meet. Both sides of the triangle count. Touching is an
/// overlap. A triangle without area is a segment or a point.
///
/// 1. the result does not depend on the order of the triangle's corners
///
/// Units: lengths. Never fails. Non-finite input: no. Source: thirteen separating axes (Akenine-Moeller, Fast 3D
/// Triangle-Box Overlap Testing, 2001). The comparisons along the coordinate axes do not round. The plane's normal is
/// the cross product of an edge and the height on it, so the normal of a thin triangle is as accurate as any other.
template <class Tier = Fast, class T>
[[nodiscard]] inline Decision<T> aabox_triangle_overlap(const AABox<T>& box,
                                                        const Triangle<T>& triangle) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(aabox_triangle_overlap, TierOfDecisions<Tier>, box, triangle);
}

namespace contracts {

/// First order. An edge, and a corner relative to its start, have an error of 1 eps of 2 G each, their product and sum
/// 2 eps. With two terms for the box and two for the apex that is 4 * 4 * 2 eps of G along the unit axis. For the
/// plane, the height has an error of 8 eps of 4 G, for which moving the apex accounts; the normal has an error of
/// 3 eps, and the sum of three products 5 eps, of 4 G. Measured along the direction between box and triangle the errors
/// are at most sqrt(3) times as large.
template <class Tier = Fast, class T = double>
constexpr Contract aabox_triangle_overlap() {
  return Tier::template contract<T>({.backward = 112, .lowest = lowest_for<T>(5), .highest = highest_for<T>(5)});
}

}  // namespace contracts
}  // namespace collide
