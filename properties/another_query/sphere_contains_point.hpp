/// Whether a sphere contains a point.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether `point` lies in the closed ball `sphere`.
template <class Tier = Fast, class T>
Decision<T> sphere_contains_point(const Sphere<T>& sphere, const Vec3<T>& point) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return sphere_contains_point<decltype(by)>(a...); }, sphere, point);
  }
  const Vec3<T> m = point - sphere.center;
  return {Tier::dot(m, m) <= sphere.radius * sphere.radius};
}

namespace inputs {
template <class T>
struct sphere_contains_point {
  Sphere<T> sphere{};
  Vec3<T> point{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &sphere_contains_point::sphere),
                      member("point", &sphere_contains_point::point, Role::position));
  }
  template <class Tier>
  auto ask() const noexcept {
    return collide::sphere_contains_point<Tier>(sphere, point);
  }

  /// First order, G the largest position: a difference carries 2 eps G, the squares 4 eps.
  static constexpr Contract contract(Fast) {
    return {.backward = 16, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)};
  }
};
}  // namespace inputs
}  // namespace collide
