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
#if defined(COLLIDE_LANES)
  if constexpr (in_lanes<Tier, T>) {
    using detail::lanes;
    using L = detail::Lanes<T>;
    const L center = lanes(sphere.center), middle = lanes(box.center), half = lanes(box.half);
    const L q = lanes(box.orientation), radius = L::all(sphere.radius), zero = L::all(T(0));
    const detail::FrameInLanes<T> frame(q);
    const L local = frame.into(center - middle), away = excess(local, half);
    const L distance2 = sum_of_three(away * away), is_outside = zero < distance2;
    using limits = std::numeric_limits<T>;
    const L in_range = (L::all(limits::min() / limits::epsilon()) <= distance2) & (distance2 <= L::all(limits::max() / T(16)));
    // Of the other arguments all that is not finite leaves a lane of `away` that is not.
    if (all_three(are_finite(half, radius) & (in_range | (away == zero)))) {
      const L to_face = half - absolute(local), to_nearest_face = without(smallest_of_three(to_face), is_outside);
      const L side = L::all(T(1)) ^ (local & L::all(T(-0.0)));
      const L face = without(first_of_three(to_face == to_nearest_face) & side, is_outside);
      const L distance = sqrt(distance2), depth = radius - distance + to_nearest_face, overlap = zero <= depth;
      const L outward = face | ((away / distance) & is_outside);
      const L normal = (zero - frame.out_of(outward)) & overlap;
      const L contact = center + normal * select(is_outside, distance, radius);
      return {depth.first(), first_three(normal), first_three(contact & overlap)};
    }
  }
#endif
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
  /// the distance, at most 3.5 G; the way back to the world adds 15 eps of 3.5 G at most, for the length and the
  /// quotient by it count as well where the contact is reached along the normal.
  static constexpr Contract contract(Fast) {
    return {.backward = 128, .unit = 40, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)};
  }
};
}  // namespace inputs
}  // namespace collide
