/// How deep a sphere overlaps a box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The penetration depth of `sphere` and the solid `box`, with one contact.
///
/// Center outside: depth = radius - distance, the contact is the point of the box nearest to the
/// center, the normal points from the center to it. Center inside or on the surface: depth = radius +
/// distance to the nearest face, the contact is the sphere's deepest point, the normal points into
/// the box. Apart: only the depth, negative, is given.
///
/// 1. depth >= 0 exactly when the closed sets meet
/// 2. moving the sphere by -depth * normal makes them touch
template <class Tier = Fast, class T>
Penetration<T> sphere_box_penetration(const Sphere<T>& sphere, const Box<T>& box) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return sphere_box_penetration<decltype(by)>(a...); }, sphere, box);
  }
  const Axes<T> axes = axes_of(box.orientation);
  const std::array<T, 3> half = components(box.half);
  const std::array<T, 3> local = into_frame<Tier>(axes, sphere.center - box.center);
  std::array<T, 3> away;
  for (int i = 0; i < 3; ++i) away[i] = excess(local[i], half[i]);
  if (const T distance = length(away); !(distance <= T(0))) {
    const T depth = sphere.radius - distance;
    if (!(depth >= T(0))) return {depth};
    std::array<T, 3> nearest;
    for (int i = 0; i < 3; ++i) nearest[i] = clamped(local[i], -half[i], half[i]);
    const Vec3<T> outward = unit<Tier>(Vec3<T>{away[0], away[1], away[2]});  // `distance` of subnormals has few digits
    return {depth, -out_of_frame(axes, components(outward)), box.center + out_of_frame(axes, nearest)};
  }
  const NearestFace<T> face = nearest_face(local, half);
  const Vec3<T> normal = axes[face.axis] * -face.side;
  return {sphere.radius + face.distance, normal, sphere.center + normal * sphere.radius};
}

namespace inputs {
template <class T>
struct sphere_box_penetration {
  Sphere<T> sphere{};
  Box<T> box{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &sphere_box_penetration::sphere),
                      member("box", &sphere_box_penetration::box));
  }
  template <class Tier>
  auto ask() const noexcept {
    return collide::sphere_box_penetration<Tier>(sphere, box);
  }

  /// First order, G the largest position: an axis carries 16 eps, a coordinate in the box frame 19 eps of
  /// the distance, at most 4 G; the way back to the world adds 12 eps of 4 G at most.
  static constexpr Contract contract(Fast) {
    return {.backward = 128, .unit = 40, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)};
  }
};
}  // namespace inputs
}  // namespace collide
