/// Whether a sphere and a triangle overlap.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/sphere_triangle_overlap.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether the closed ball and the closed triangle meet. Both sides of the triangle count. Touching is an overlap. A
/// triangle without area is a segment or a point.
///
/// 1. the result does not depend on the order of the triangle's corners
///
/// Units: lengths. Never fails. Non-finite input: no. Source: the distance of the center from the triangle: from the
/// foot of the perpendicular if that lies in the triangle, else from the closest edge.
template <class Tier = Fast, class T>
[[nodiscard]] inline Decision<T> sphere_triangle_overlap(const Sphere<T>& sphere,
                                                         const Triangle<T>& triangle) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(sphere_triangle_overlap, TierOfDecisions<Tier>, sphere, triangle);
}

namespace contracts {

/// First order. The foot has an error of 72 eps of G, as in closest_point_rectangle. The distance from it has an error
/// of 1 eps of 2 G and half of 5 eps of at most 4 G; the radius half of 2 eps.
template <class Tier = Fast, class T = double>
constexpr Contract sphere_triangle_overlap() {
  return Tier::template contract<T>({.backward = 84, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
