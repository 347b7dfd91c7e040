/// Whether a point lies in a rectangle, both projected along an axis.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/point_in_rectangle.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether `point` lies in the closed `rectangle`, the union of the triangles v0, v1, v2 and v0, v2, v3. Both are
/// projected along the coordinate axis in which `normal` has its component of largest magnitude (the first of equal
/// ones). Points on the boundary are inside.
///
/// 1. point_in_rectangle(r, n, p) == point_in_triangle({v0, v1, v2}, n, -1, p) or ({v0, v2, v3}, n, -1, p)
///
/// One number decides the diagonal for both triangles, so no point on it is lost. Never fails. Non-finite input: no.
/// Source: the signs of the edge functions (as in Pineda, A Parallel Algorithm for Polygon Rasterization, 1988).
template <class Tier = Fast, class T>
[[nodiscard]] inline Decision<T> point_in_rectangle(const Rectangle<T>& rectangle, const Vec3<T>& normal,
                                                    const Vec3<T>& point) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(point_in_rectangle, TierOfDecisions<Tier>, rectangle, normal, point);
}

namespace contracts {

/// First order: the edge functions as in point_in_triangle, 33.
template <class Tier = Fast, class T = double>
constexpr Contract point_in_rectangle() {
  return Tier::template contract<T>({.backward = 33, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
