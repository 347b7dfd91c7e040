/// Whether a sphere and a triangle overlap.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/sphere_triangle_overlap.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether the closed ball and the closed triangle, seen from either side, meet. A triangle without area is
/// a segment or a point.
///
/// 1. the order of the triangle's corners plays no part
///
/// Source: the distance of the center from the triangle: to the foot of the perpendicular where it lies in
/// the triangle, else to the nearest edge.
template <class Tier = Fast, class T>
[[nodiscard]] Decision<T> sphere_triangle_overlap(const Sphere<T>& sphere,
                                                  const Triangle<T>& triangle) noexcept(Tier::never_throws) {
  return kernels::sphere_triangle_overlap<Tier>(sphere, triangle);
}

namespace contracts {

/// First order, G the largest position: the foot as in closest_point_rectangle, 72 eps G; the distance
/// from it 1 eps of 2 G and half of 5 eps of at most 4 G; the radius half of 2 eps.
template <class Tier = Fast, class T = double>
constexpr Contract sphere_triangle_overlap() {
  return Tier::template contract<T>({.backward = 84, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
