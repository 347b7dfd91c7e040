/// When and where a moving point meets a one-sided triangle.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
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
Impact<T> moving_point_triangle(const Vec3<T>& point, const Vec3<T>& velocity,
                                const Triangle<T>& triangle) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return moving_point_triangle<decltype(by)>(a...); }, point, velocity, triangle);
  }
  const Vec3<T> n = Tier::cross(triangle.v1 - triangle.v0, triangle.v2 - triangle.v0);
  const T approach = -Tier::dot(n, velocity);
  if (!(approach > T(0))) return Impact<T>::miss();
  const Vec3<T> a = triangle.v0 - point;
  const T behind = Tier::dot(n, a);
  if (!(behind <= T(0))) return Impact<T>::miss();
  const Vec3<T> b = triangle.v1 - point;
  const Vec3<T> c = triangle.v2 - point;
  const bool inside = Tier::dot(velocity, Tier::cross(a, b)) <= T(0) &&
                      Tier::dot(velocity, Tier::cross(b, c)) <= T(0) &&
                      Tier::dot(velocity, Tier::cross(c, a)) <= T(0);
  if (!inside) return Impact<T>::miss();
  const T time = -behind / approach;
  return {time, point + velocity * time, unit<Tier>(n)};
}

namespace inputs {
template <class T>
struct moving_point_triangle {
  Vec3<T> point{};
  Vec3<T> velocity{};
  Triangle<T> triangle{};

  static constexpr auto members() {
    return std::tuple(member("point", &moving_point_triangle::point, Role::position),
                      member("velocity", &moving_point_triangle::velocity, Role::velocity),
                      member("triangle", &moving_point_triangle::triangle));
  }
  template <class Tier>
  auto ask() const noexcept {
    return collide::moving_point_triangle<Tier>(point, velocity, triangle);
  }

  /// First order, G the largest position: an edge or a corner seen from the point is a difference of two
  /// positions, known to 2 eps G; each product of a cross product carries 3 eps more of 2 G, the dot
  /// product 3 eps: corners and point move by at most 2 + 2 * 3 + 3 eps of 2 G each, for the plane and
  /// again for the edges; the location adds 2 eps of 2 G. The velocity takes 3 eps of its own.
  static constexpr Contract contract(Fast) {
    return {.backward = 48, .unit = 4, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)};
  }
};
}  // namespace inputs
}  // namespace collide
