/// Whether a point lies in a triangle, both seen along an axis.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/point_in_triangle.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether `point` lies in the closed `triangle`, both seen along an axis: `axis` 0..2, or, for -1, that of
/// the component of `normal` of largest magnitude (of several the first).
///
/// 1. seen along the axis, point == x v0 + y v1 + z v2 with the weights x, y, z, none of them negative,
///    x + y + z == 1
/// 2. a triangle that has no area seen along the axis is a segment or a point, and any such weights are right
///
/// Units: none for the weights. Source: the sides of the edges (as in Pineda, A Parallel Algorithm for
/// Polygon Rasterization, 1988); the weights by orthogonalization, which suits thin triangles.
template <class Tier = Fast, class T>
[[nodiscard]] Containment<T> point_in_triangle(const Triangle<T>& triangle, const Vec3<T>& normal, int axis,
                                               const Vec3<T>& point) noexcept(Tier::never_throws) {
  return kernels::point_in_triangle<Tier>(triangle, normal, axis, point);
}

namespace contracts {

/// First order, G the largest position: a corner seen from the point carries 1 eps of 2 G; the side of an
/// edge 3 eps of that distance (at most 3 G), which moving the point by three times as much (the tip of a
/// triangle cut off by its bounds) explains: 33. The weights: a foot in the plane as in
/// closest_point_rectangle, 72 eps G, and the edge's instead, within as much.
template <class Tier = Fast, class T = double>
constexpr Contract point_in_triangle() {
  return Tier::template contract<T>({.backward = 105, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
