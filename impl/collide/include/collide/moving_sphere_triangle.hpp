/// When and where a moving sphere meets a one-sided triangle.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_sphere_triangle.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `sphere`, moving by `velocity` per unit of time, with `triangle`.
///
/// With n = (v1 - v0) x (v2 - v0), a sphere that moves against n, n . velocity > 0, or starts wholly behind
/// the plane, n . (center - v0) < -radius |n|, misses. Otherwise it meets the closed triangle, its edges and
/// vertices too: an overlap at the start is a contact at time 0, so is a touch unless the sphere leaves.
/// A triangle without area is a segment or a point and has no back. Location is the triangle's point
/// nearest to the center at that time, `weights` are its barycentric coordinates.
///
/// 1. |center + velocity * time - location| == radius, but for an overlap at the start
/// 2. normal points from location to the center; where the center is on the triangle it is an outward one, and not
/// along
///    the motion
/// 3. location == weights.x v0 + weights.y v1 + weights.z v2, weights.x + weights.y + weights.z == 1
///
/// Source: the points within the radius of a triangle are a prism over its face, a cylinder about each edge
/// and a ball about each vertex; the first contact is the first entry into any of them (Ericson, Real-Time
/// Collision Detection, 5.5.3, the sphere swept against features). Each cylinder is cut where its edge ends, no ball
/// is, so nothing passes between the parts.
template <class Tier = Fast, class T>
[[nodiscard]] TriangleImpact<T> moving_sphere_triangle(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                                       const Triangle<T>& triangle) noexcept(Tier::never_throws) {
  return kernels::moving_sphere_triangle<Tier>(sphere, velocity, triangle);
}

namespace contracts {

/// First order, G the largest position: the center seen from a corner and an edge are known to 2 eps of G,
/// at most 2 G long; a unit edge adds 5 eps, a moment 5 eps of 4 G^2 and the speed, the root of the chord
/// half of 8 eps, the way to the contact 3 eps of 4 G and the location 4 eps of 2 G more; the face's
/// normal takes 5 eps of the edges, its weights as much again: 64 eps together. Unit: a root of three squares.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_triangle() {
  return Tier::template contract<T>(
      {.backward = 128, .unit = 8, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
