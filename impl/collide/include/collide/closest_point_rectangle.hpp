/// The point of a rectangle nearest to a point.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/closest_point_rectangle.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The point nearest to `point` in `rectangle`, the union of the triangles v0, v1, v2 and v0, v2, v3; any of
/// them where several are.
///
/// 1. the result lies in one of the two triangles, and no point of either is nearer
///
/// Units: lengths. Never fails. Source: the foot of the perpendicular where it lies in a triangle, else the
/// nearest edge. The triangles are compared from the diagonal or from the vertices that they share.
template <class Tier = Fast, class T>
[[nodiscard]] ClosestPoint<T> closest_point_rectangle(const Rectangle<T>& rectangle,
                                                      const Vec3<T>& point) noexcept(Tier::never_throws) {
  return kernels::closest_point_rectangle<Tier>(rectangle, point);
}

namespace contracts {

/// First order, G the largest position: differences carry 1 eps of 2 G, a share of the diagonal 4 eps of
/// the distance (at most 4 G) along it, the height 6 eps of 4 G, which moving the corners explains; the
/// foot measured along the height 6 eps of 4 G, sums and products 3 eps of 2 G: in all 2 + 16 + 24 + 24 + 6.
/// An edge costs less: 46, as in closest_point_triangle_perimeter.
template <class Tier = Fast, class T = double>
constexpr Contract closest_point_rectangle() {
  return Tier::template contract<T>({.backward = 72, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
