/// When and where a moving point meets a one-sided triangle.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_triangle.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `point`, moving by `velocity` per unit of time, with the front of `triangle`.
///
/// Front is the side to which n = (v1 - v0) x (v2 - v0) points. A hit needs n . velocity < 0, a start
/// on the plane or in front of it, and a plane point inside the closed triangle. A start behind, a
/// motion along the plane, zero velocity and a triangle without area are misses.
///
/// 1. location == point + velocity * time (exactly, in real numbers)
/// 2. normal == n / |n|
///
/// Two triangles that share an edge decide it with opposite signs of the same number, so no motion
/// passes between them. Source: signed volumes of the tetrahedra that the line of motion forms with
/// the edges (Pluecker coordinates; Ericson, Real-Time Collision Detection, 5.3.4).
template <class Tier = Fast, class T>
[[nodiscard]] Impact<T> moving_point_triangle(const Vec3<T>& point, const Vec3<T>& velocity,
                                              const Triangle<T>& triangle) noexcept(Tier::never_throws) {
  return kernels::moving_point_triangle<Tier>(point, velocity, triangle);
}

namespace contracts {

/// First order, G the largest position: an edge or a corner seen from the point is a difference of two
/// positions, known to 2 eps G; each product of a cross product carries 3 eps more of 2 G, the dot
/// product 3 eps: corners and point move by at most 2 + 2 * 3 + 3 eps of 2 G each, for the plane and
/// again for the edges; the location adds 2 eps of 2 G. The velocity takes 3 eps of its own. The kernel in lanes moves
/// ends of an edge by 30 eps G for the normal, corners by 12 for the plane, and adds 2 eps of 2 G.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_triangle() {
  return Tier::template contract<T>(
      {.backward = 48, .unit = 4, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
