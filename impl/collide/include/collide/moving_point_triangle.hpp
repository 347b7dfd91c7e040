/// The time and place at which a moving point hits a one-sided triangle.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_triangle.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `point`, moving by `velocity` per unit of time, with the front of `triangle`.
///
/// The front is the side to which n = (v1 - v0) x (v2 - v0) points. A hit requires n . velocity < 0, a start on the
/// plane or in front of it, and a point of the plane inside the closed triangle; edges and vertices count. A start
/// behind the plane, a motion parallel to it, zero velocity and a triangle without area are misses.
///
/// 1. location == point + velocity * time (exactly, in real numbers)
/// 2. normal == n / |n|
///
/// Two triangles that share an edge use the same number with opposite signs to decide it, so no motion passes between
/// them. Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source: signed
/// volumes of the tetrahedra that the line of motion forms with the edges (Pluecker coordinates; Ericson, Real-Time
/// Collision Detection, 5.3.4).
template <class Tier = Fast, class T>
[[nodiscard]] inline Impact<T> moving_point_triangle(const Vec3<T>& point, const Vec3<T>& velocity,
                                                     const Triangle<T>& triangle) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_point_triangle, Tier, point, velocity, triangle);
}

namespace contracts {

/// First order. An edge, and a corner relative to the point, are differences of two positions with an error of 2 eps of
/// G. Each product of a cross product adds 3 eps of 2 G, and the dot product 3 eps. Moving the corners and the point by
/// at most 2 + 2 * 3 + 3 eps of 2 G each accounts for these, once for the plane and once for the edges. The location
/// adds 2 eps of 2 G. The velocity takes 3 eps of its own. In the lanes kernel, moving the ends of an edge by 30 eps of
/// G accounts for the normal and moving the corners by 12 eps for the plane; it adds 2 eps of 2 G.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_triangle() {
  return Tier::template contract<T>(
      {.backward = 48, .unit = 4, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
