/// Whether a point lies in a triangle, both projected along an axis.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/point_in_triangle.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether `point` lies in the closed `triangle`, both projected along a coordinate axis. `axis` is that axis, 0..2;
/// for -1 it is the axis in which `normal` has its component of largest magnitude (the first of equal ones). Points on
/// the boundary are inside.
///
/// 1. in the projection, point == x v0 + y v1 + z v2 with the weights x, y, z, none of them negative, x + y + z == 1
/// 2. a triangle whose projection has no area is a segment or a point, and any weights that satisfy 1 are allowed
///
/// The weights have no unit. Never fails. Non-finite input: no. Source: the signs of the edge functions (as in Pineda,
/// A Parallel Algorithm for Polygon Rasterization, 1988); the weights by orthogonalization, which is accurate for thin
/// triangles.
template <class Tier = Fast, class T>
[[nodiscard]] inline Containment<T> point_in_triangle(const Triangle<T>& triangle, const Vec3<T>& normal, int axis,
                                                      const Vec3<T>& point) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(point_in_triangle, TierOfDecisions<Tier>, triangle, normal, axis, point);
}

namespace contracts {

/// First order. A corner relative to the point has an error of 1 eps of 2 G. The edge function has an error of 3 eps of
/// that distance (at most 3 G). Moving the point by three times as much accounts for it, since the bounds cut off the
/// tip of a triangle: 33. The weights: the foot in the plane has an error of 72 eps of G, as in
/// closest_point_rectangle; where the closest edge's foot is used instead, it lies within as much.
template <class Tier = Fast, class T = double>
constexpr Contract point_in_triangle() {
  return Tier::template contract<T>({.backward = 105, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
