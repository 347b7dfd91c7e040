/// When and where a moving point meets a one-sided rectangle.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_rectangle.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `point`, moving by `velocity` per unit of time, with the front of `rectangle`: of
/// its triangles v0, v1, v2 and v0, v2, v3, each with the front of its own, the one that is hit earlier.
///
/// A hit of a triangle needs n . velocity < 0, a start on its plane or in front of it, and a plane point
/// inside the closed triangle.
///
/// 1. location == point + velocity * time (exactly, in real numbers)
/// 2. normal == n / |n| of a triangle that is hit at that time
///
/// Source: signed volumes of the tetrahedra that the line of motion forms with the five edges; the diagonal
/// decides both triangles by one number, so no motion passes between them.
template <class Tier = Fast, class T>
[[nodiscard]] Impact<T> moving_point_rectangle(const Vec3<T>& point, const Vec3<T>& velocity,
                                               const Rectangle<T>& rectangle) noexcept(Tier::never_throws) {
  return kernels::moving_point_rectangle<Tier>(point, velocity, rectangle);
}

namespace contracts {

/// First order, as for a triangle: an edge or a corner seen from the point is known to 2 eps of the largest
/// position G, each product of a cross product carries 3 eps more of 2 G, the dot product 3 eps, for the
/// plane and again for the edges; the location adds 2 eps of 2 G.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_rectangle() {
  return Tier::template contract<T>(
      {.backward = 48, .unit = 4, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
