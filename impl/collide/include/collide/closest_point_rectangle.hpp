/// The point of a rectangle closest to a point.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/closest_point_rectangle.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The point of `rectangle` closest to `point`. The rectangle is the union of the triangles v0, v1, v2 and v0, v2, v3;
/// any four points are allowed. If several points are equally close, the result is any of them.
///
/// 1. the result lies in one of the two triangles, and no point of either is closer
///
/// Units: lengths. Never fails. Non-finite input: a point that is not finite. Source: the foot of the perpendicular if
/// it lies in a triangle, else the closest edge. The two triangles are compared by distances measured from their common
/// diagonal or a common vertex.
template <class Tier = Fast, class T>
[[nodiscard]] inline ClosestPoint<T> closest_point_rectangle(const Rectangle<T>& rectangle,
                                                             const Vec3<T>& point) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(closest_point_rectangle, TierOfNumbers<Tier>, rectangle, point);
}

namespace contracts {

/// First order. Differences have an error of 1 eps of 2 G. The position along the diagonal has an error of 4 eps of the
/// distance (at most 4 G). The height has an error of 6 eps of 4 G, for which moving the corners accounts. The foot,
/// measured along the height, has an error of 6 eps of 4 G, sums and products 3 eps of 2 G. In all 2 + 16 + 24 + 24 + 6
/// = 72. An edge has smaller errors: 46, as in closest_point_triangle_perimeter.
template <class Tier = Fast, class T = double>
constexpr Contract closest_point_rectangle() {
  return Tier::template contract<T>({.backward = 72, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
