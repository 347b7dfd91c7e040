/// The time and place at which a moving sphere hits a one-sided triangle.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_sphere_triangle.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `sphere`, moving by `velocity` per unit of time, with `triangle`.
///
/// With n = (v1 - v0) x (v2 - v0), a sphere that moves along n (n . velocity > 0) or starts wholly behind the plane
/// (n . (center - v0) < -radius |n|) is a miss. Otherwise it can hit the closed triangle: the face, edges and vertices.
/// An overlap at the start is a contact at time 0. A touch at the start is a contact at time 0 unless the sphere moves
/// away. A triangle without area is a segment or a point and can be hit from all sides. The location is the point of
/// the triangle closest to the center at the time of contact; `weights` are its barycentric coordinates.
///
/// 1. |center + velocity * time - location| == radius, except for an overlap at the start
/// 2. normal points from location to the center; for a center on the triangle it is an outward normal with
///    normal . velocity <= 0
/// 3. location == weights.x v0 + weights.y v1 + weights.z v2, weights.x + weights.y + weights.z == 1
///
/// Units: lengths; velocity is length per unit of time; weights have none. Never fails. Non-finite input: a miss.
/// Source: the points within the radius of a triangle are the union of a prism over its face, a cylinder about each
/// edge and a ball about each vertex; the first contact is the first entry into any of them (Ericson, Real-Time
/// Collision Detection, 5.5.3, the sphere swept against features). Each cylinder ends where its edge ends and each ball
/// is whole, so nothing passes between the parts.
template <class Tier = Fast, class T>
[[nodiscard]] inline TriangleImpact<T> moving_sphere_triangle(
    const Sphere<T>& sphere, const Vec3<T>& velocity, const Triangle<T>& triangle) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_sphere_triangle, TierOfDecisions<Tier>, sphere, velocity, triangle);
}

namespace contracts {

/// First order. The center relative to a corner, and an edge, have an error of 2 eps of G and are at most 2 G long. A
/// unit edge adds 5 eps, and a moment 5 eps of 4 G^2 and the speed. The root of the chord has an error of half of
/// 8 eps. The displacement to the contact adds 3 eps of 4 G, the location 4 eps of 2 G. The normal of the face has an
/// error of 5 eps of the edges, and its weights as much again. In all 64 eps. Unit: the square root of a sum of three
/// squares.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_triangle() {
  return Tier::template contract<T>(
      {.backward = 128, .unit = 8, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
