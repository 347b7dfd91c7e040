/// Whether a sphere and a triangle overlap.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/edges.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether the closed ball and the closed triangle, seen from either side, meet. A triangle without area is
/// a segment or a point.
///
/// 1. the order of the triangle's corners plays no part
///
/// Source: the distance of the center from the triangle: to the foot of the perpendicular where it lies in
/// the triangle, else to the nearest edge.
template <class Tier = Fast, class T>
Decision<T> sphere_triangle_overlap(const Sphere<T>& sphere, const Triangle<T>& triangle) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return sphere_triangle_overlap<decltype(by)>(a...); }, sphere, triangle);
  }
  if constexpr (MachineNumber<T>) {
    const Vec3<T> all = triangle.v0 + triangle.v1 + triangle.v2;
    if (!detail::is_finite(all) || !(sphere.radius <= std::numeric_limits<T>::max())) return {false};
  }
  const auto reaches = [&](const Vec3<T>& away) {
    return Tier::beyond_radius(away, sphere.radius) <= T(0);
  };
  const Vec3<T> base = triangle.v1 - triangle.v0, w = sphere.center - triangle.v0;
  const detail::FaceFoot<T> face = detail::foot_on_face<Tier>(base, triangle.v2 - triangle.v0, w);
  if (face.inside) return {reaches(w - face.from_start(base))};
  const std::array<Vec3<T>, 3> v = detail::corners(triangle);
  for (int i = 0; i < 3; ++i) {
    if (reaches(sphere.center - v[i] - detail::foot_on_edge<Tier>(v[i], v[(i + 1) % 3], sphere.center).from_start)) {
      return {true};
    }
  }
  return {false};
}

namespace inputs {
template <class T>
struct sphere_triangle_overlap {
  Sphere<T> sphere{};
  Triangle<T> triangle{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &sphere_triangle_overlap::sphere),
                      member("triangle", &sphere_triangle_overlap::triangle));
  }
  template <class Tier>
  auto ask() const noexcept {
    return collide::sphere_triangle_overlap<Tier>(sphere, triangle);
  }

  /// First order, G the largest position: the foot as in closest_point_rectangle, 72 eps G; the distance
  /// from it 1 eps of 2 G and half of 5 eps of at most 4 G; the radius half of 2 eps.
  static constexpr Contract contract(Fast) {
    return {.backward = 84, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)};
  }
};
}  // namespace inputs
}  // namespace collide
