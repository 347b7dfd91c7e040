/// Whether an axis-aligned box and a triangle overlap.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/aabox_triangle_overlap.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether the closed axis-aligned box and the closed triangle, seen from either side, meet. A triangle
/// without area is a segment or a point.
///
/// 1. the order of the triangle's corners plays no part
///
/// Source: thirteen separating axes (Akenine-Moeller, Fast 3D Triangle-Box Overlap Testing, 2001). The
/// coordinate axes are compared without rounding; the plane's normal is made of an edge and of the other one
/// at right angles to it, so that a thin triangle has as good a normal as any other.
template <class Tier = Fast, class T>
[[nodiscard]] Decision<T> aabox_triangle_overlap(const AABox<T>& box,
                                                 const Triangle<T>& triangle) noexcept(Tier::never_throws) {
  return kernels::aabox_triangle_overlap<Tier>(box, triangle);
}

namespace contracts {

/// First order, G the largest position: an edge and a corner seen from its start carry 1 eps of 2 G each,
/// their product and sum 2 eps: two terms for the box and two for the apex, 4 * 4 * 2 eps G along the unit
/// axis. The plane: the height 8 eps of 4 G, which moving the apex explains, the normal 3 eps and the sum of
/// three products 5 eps of 4 G. Along the direction between box and triangle at most sqrt(3) times as much.
template <class Tier = Fast, class T = double>
constexpr Contract aabox_triangle_overlap() {
  return Tier::template contract<T>({.backward = 112, .lowest = lowest_for<T>(5), .highest = highest_for<T>(5)});
}

}  // namespace contracts
}  // namespace collide
