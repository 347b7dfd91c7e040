/// When and where a moving point meets a one-sided triangle that is asked about many times.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_triangle_prepared.hpp>
#include <collide/prepared.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// What `moving_point_triangle` answers, from a triangle whose normal and edges are known.
///
/// 1. location == point + velocity * time (exactly, in real numbers)
/// 2. normal == n / |n|
///
/// Source: Cramer's rule in the edges' frame, with the edges' cross product known (Moeller, Trumbore, Fast,
/// Minimum Storage Ray/Triangle Intersection, 1997).
template <class Tier = Fast, class T>
[[nodiscard]] Impact<T> moving_point_triangle_prepared(
    const Vec3<T>& point, const Vec3<T>& velocity, const PreparedTriangle<T>& prepared) noexcept(Tier::never_throws) {
  return kernels::moving_point_triangle_prepared<Tier>(point, velocity, prepared);
}

namespace contracts {

/// First order, G the largest position: edges and the way from v0 are known to 1 eps of 2 G; the normal and
/// the moment carry 3 eps more in each product, the dot products 3 eps: corners and point move by at most
/// 2 + 3 + 3 eps of 2 G for the plane, and again for the edges, and the third edge 3 eps of the sum; the
/// location adds 2 eps of 2 G. The velocity takes 3 eps of its own.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_triangle_prepared() {
  return Tier::template contract<T>(
      {.backward = 48, .unit = 4, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
