/// Whether a sphere and a box overlap.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether the closed ball and the solid box meet.
///
/// 1. sphere_box_overlap(s, b) == (sphere_box_penetration(s, b).depth >= 0) in real numbers
///
/// Source: in the box's frame the squared distance is the sum of the squared excesses of each coordinate
/// (Arvo, A Simple Method for Box-Sphere Intersection Testing, Graphics Gems, 1990).
template <class Tier = Fast, class T>
Decision<T> sphere_box_overlap(const Sphere<T>& sphere, const Box<T>& box) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return sphere_box_overlap<decltype(by)>(a...); }, sphere, box);
  }
  const Axes<T> axes = axes_of(box.orientation);
  const std::array<T, 3> half = components(box.half);
  const std::array<T, 3> local = into_frame<Tier>(axes, sphere.center - box.center);
  const Vec3<T> away{excess(local[0], half[0]), excess(local[1], half[1]), excess(local[2], half[2])};
  if constexpr (MachineNumber<T>) {
    if (!(sphere.radius + half[0] + half[1] + half[2] <= std::numeric_limits<T>::max())) return {false};
  }
  return {Tier::beyond_radius(away, sphere.radius) <= T(0)};
}

namespace inputs {
template <class T>
struct sphere_box_overlap {
  Sphere<T> sphere{};
  Box<T> box{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &sphere_box_overlap::sphere), member("box", &sphere_box_overlap::box));
  }
  template <class Tier>
  auto ask() const noexcept {
    return collide::sphere_box_overlap<Tier>(sphere, box);
  }

  /// First order, G the largest position: an axis carries 16 eps, a coordinate in the box frame 19 eps of
  /// the distance, at most 4 G; excess, squares, sum and the radius 4 eps more of as much.
  static constexpr Contract contract(Fast) {
    return {.backward = 92, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)};
  }
};
}  // namespace inputs
}  // namespace collide
