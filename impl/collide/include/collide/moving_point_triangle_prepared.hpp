/// The time and place at which a moving point hits a one-sided triangle, for a prepared triangle.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_triangle_prepared.hpp>
#include <collide/prepared.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The same as `moving_point_triangle`, for a triangle whose edges and normal were computed before
/// (`prepare_triangle`).
///
/// 1. location == point + velocity * time (exactly, in real numbers)
/// 2. normal == n / |n|
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source: Cramer's rule in
/// the frame of the edges, with their cross product known (Moeller, Trumbore, Fast, Minimum Storage Ray/Triangle
/// Intersection, 1997).
template <class Tier = Fast, class T>
[[nodiscard]] inline Impact<T> moving_point_triangle_prepared(
    const Vec3<T>& point, const Vec3<T>& velocity, const PreparedTriangle<T>& prepared) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_point_triangle_prepared, Tier, point, velocity, prepared);
}

namespace contracts {

/// First order. The edges and the vector from v0 to the point have an error of 1 eps of 2 G. The normal and the moment
/// add 3 eps in each product, the dot products 3 eps. Moving the corners and the point by at most 2 + 3 + 3 eps of 2 G
/// accounts for these, once for the plane and once for the edges. Where the sign of a weight is uncertain,
/// moving_point_triangle decides. The location adds 2 eps of 2 G. The velocity takes 3 eps of its own.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_triangle_prepared() {
  return Tier::template contract<T>(
      {.backward = 48, .unit = 4, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
