/// When and where a moving point meets a one-sided rectangle.
#pragma once

#include <collide/moving_point_triangle.hpp>

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
Impact<T> moving_point_rectangle(const Vec3<T>& point, const Vec3<T>& velocity,
                                 const Rectangle<T>& rectangle) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return moving_point_rectangle<decltype(by)>(a...); }, point,
                      velocity, rectangle);
  }
  const Vec3<T> a = rectangle.v0 - point, b = rectangle.v1 - point;
  const Vec3<T> c = rectangle.v2 - point, d = rectangle.v3 - point;
  const Vec3<T> diagonal = rectangle.v2 - rectangle.v0;
  const T beside = Tier::dot(velocity, Tier::cross(c, a));  // the diagonal: negative on v1's side
  T time = std::numeric_limits<T>::infinity();
  Vec3<T> normal{};
  const auto meet = [&](const Vec3<T>& edge1, const Vec3<T>& edge2) {
    const Vec3<T> n = detail::normal_of<Tier>(edge1, edge2);
    const T approach = -Tier::dot(n, velocity), behind = Tier::dot(n, a);
    if (!(approach > T(0) && behind <= T(0))) return;
    const T at = detail::time_in_triangle<Tier>(T(-behind / approach), velocity, n, a, edge1, edge2);
    if (at >= T(0) && at < time) time = at, normal = n;
  };
  if (beside <= T(0) && Tier::dot(velocity, Tier::cross(a, b)) <= T(0) &&
      Tier::dot(velocity, Tier::cross(b, c)) <= T(0)) {
    meet(rectangle.v1 - rectangle.v0, diagonal);
  }
  if (beside >= T(0) && Tier::dot(velocity, Tier::cross(c, d)) <= T(0) &&
      Tier::dot(velocity, Tier::cross(d, a)) <= T(0)) {
    meet(diagonal, rectangle.v3 - rectangle.v0);
  }
  if (!(time <= std::numeric_limits<T>::max())) return Impact<T>::miss();
  return detail::contact(time, point + velocity * time, unit<Tier>(normal));
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
