/// The time and place at which a moving point hits a one-sided rectangle.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_rectangle.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `point`, moving by `velocity` per unit of time, with the front of `rectangle`: the earlier hit
/// of its triangles v0, v1, v2 and v0, v2, v3. Each triangle has its own front, the side to which its n = (b - a) x (c
/// - a) points for its corners a, b, c in that order.
///
/// A hit of a triangle requires n . velocity < 0, a start on its plane or in front of it, and a point of the plane
/// inside the closed triangle. Edges count. A triangle without area is not hit.
///
/// 1. location == point + velocity * time (exactly, in real numbers)
/// 2. normal == n / |n| of a triangle that is hit at that time
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source: signed volumes
/// of the tetrahedra that the line of motion forms with the five edges. One number decides the diagonal for both
/// triangles, so no motion passes between them.
template <class Tier = Fast, class T>
[[nodiscard]] inline Impact<T> moving_point_rectangle(const Vec3<T>& point, const Vec3<T>& velocity,
                                                      const Rectangle<T>& rectangle) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_point_rectangle, TierOfDecisions<Tier>, point, velocity, rectangle);
}

namespace contracts {

/// First order, as for a triangle. An edge, and a corner relative to the point, have an error of 2 eps of G. Each
/// product of a cross product adds 3 eps of 2 G, and the dot product 3 eps, once for the plane and once for the edges.
/// The location adds 2 eps of 2 G.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_rectangle() {
  return Tier::template contract<T>(
      {.backward = 48, .unit = 4, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
