/// When and where a moving point meets a one-sided triangle that is asked about many times.
#pragma once

#include <collide/moving_point_triangle.hpp>

namespace collide {

/// A triangle with what `moving_point_triangle_prepared` needs of it; made by `prepare_triangle`.
template <class T>
struct PreparedTriangle {
  Triangle<T> triangle{};
  Vec3<T> edge1{}, edge2{};  ///< from v0 to v1 and to v2
  Vec3<T> normal{};          ///< edge1 x edge2, as long as twice the area
  Vec3<T> unit_normal{};     ///< normal / |normal|; zero for a triangle without area
};

template <class Tier = Fast, class T>
PreparedTriangle<T> prepare_triangle(const Triangle<T>& triangle) noexcept {
  const Vec3<T> edge1 = triangle.v1 - triangle.v0, edge2 = triangle.v2 - triangle.v0;
  const Vec3<T> normal = detail::normal_of<Tier>(edge1, edge2);
  return {triangle, edge1, edge2, normal, unit<Tier>(normal)};
}

/// What `moving_point_triangle` answers, from a triangle whose normal and edges are known.
///
/// 1. location == point + velocity * time (exactly, in real numbers)
/// 2. normal == n / |n|
///
/// Source: Cramer's rule in the edges' frame, with the edges' cross product known (Moeller, Trumbore, Fast,
/// Minimum Storage Ray/Triangle Intersection, 1997).
template <class Tier = Fast, class T>
Impact<T> moving_point_triangle_prepared(const Vec3<T>& point, const Vec3<T>& velocity,
                                         const PreparedTriangle<T>& prepared) noexcept {
  if constexpr (Tier::template lifts<T>) {
    const auto text = [&](auto by, const auto& p, const auto& v, const auto& triangle) {
      using By = decltype(by);
      if constexpr (Tier::template keeps<T>)
        return moving_point_triangle_prepared<By>(p, v, prepared);
      else
        return moving_point_triangle_prepared<By>(p, v, prepare_triangle<By>(triangle));
    };
    return Tier::lift(text, point, velocity, prepared.triangle);
  }
  const T approach = -Tier::dot(prepared.normal, velocity);
  if (!(approach > T(0))) return Impact<T>::miss();
  const Vec3<T> from_v0 = point - prepared.triangle.v0;
  const T height = Tier::dot(prepared.normal, from_v0);
  if (!(height >= T(0))) return Impact<T>::miss();
  const Vec3<T> moment = Tier::cross(from_v0, velocity);
  const T weight1 = Tier::dot(prepared.edge2, moment);   // of v1, times approach
  const T weight2 = -Tier::dot(prepared.edge1, moment);  // of v2, times approach
  if (!(weight1 >= T(0) && weight2 >= T(0) && weight1 + weight2 <= approach)) return Impact<T>::miss();
  const T time = detail::time_in_triangle<Tier>(T(height / approach), velocity, prepared.normal, -from_v0,
                                                prepared.edge1, prepared.edge2);
  if (!(time >= T(0))) return Impact<T>::miss();
  return detail::contact(time, point + velocity * time, prepared.unit_normal);
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
