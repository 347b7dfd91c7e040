/// How deep a sphere overlaps a box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

#if defined(COLLIDE_LANES)

namespace detail {

/// What `Fast` answers; where the square of the distance says nothing about it, what `shared` does.
template <class T, class Shared>
inline Penetration<T> sphere_box_penetration_in_lanes(const Sphere<T>& sphere, const Box<T>& box,
                                                      const Shared& shared) noexcept {
  using L = Lanes<T>;
  using P = Pair<T>;
  using limits = std::numeric_limits<T>;
  const L center = lanes(sphere.center), middle = lanes(box.center), half = lanes(box.half);
  L q = lanes(box.orientation), norm_squared = sum_of_four(q * q);
  if (!is_moderate(norm_squared.first())) {
    q = out_of_line(of_moderate_length<T>)(box.orientation), norm_squared = sum_of_four(q * q);
    if (!is_moderate(norm_squared.first())) return shared(sphere, box);
  }
  const P radius = P::all(sphere.radius), zero = P::all(T(0)), one = P::first_is(T(1));
  const P no_radius = radius * zero;  // or NaN
  // The rotation times |q|^2, which is divided out beside the rotating.
  const auto frame = FrameInLanes<T>::scaled(q);
  const L inverse = every(one / first_pair(norm_squared));
  // NaN where an argument is not finite.
  const L local = frame.into(center - middle) * inverse, away = excess(local, half) + half * every(no_radius);
  const P distance2 = first_pair(sum_of_three(away * away)), is_outside = zero < distance2;
  const P in_range =
      (P::all(limits::min() / limits::epsilon()) <= distance2) & (distance2 <= P::all(limits::max() / T(16)));
  if (!holds_or_all_zero(in_range, away)) return shared(sphere, box);

  const P distance = sqrt(distance2);
  const auto answer = [&](const P& depth, const L& way, const P& per_way, const P& to_contact) COLLIDE_INLINE {
    const L overlap = every(zero <= depth), normal = way * every(per_way), contact = center - way * every(to_contact);
    return Penetration<T>{depth.first(), first_three(normal & overlap), first_three(contact & overlap)};
  };
  if constexpr (std::same_as<T, double>) {  // in two registers what only the inside needs costs more than a wrong guess
    if (distance2.first() > T(0))
      return answer(radius - distance, frame.out_of(away) * inverse, one / (zero - distance), one);
  }
  const L to_face = half - absolute(local), to_nearest_face = smallest_of_three(to_face);
  const L side = L::all(T(1)) ^ (local & L::all(T(-0.0)));
  const L face = without(first_of_three(to_face == to_nearest_face) & side, every(is_outside));
  const L way =
      frame.out_of(away | face) * inverse;  // to the contact where the center is outside, where `away` is not 0
  return answer(radius - distance + without(first_pair(to_nearest_face), is_outside), way,
                one / (zero - (distance | without(one, is_outside))), select(is_outside, one, radius));
}

}  // namespace detail

#endif

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
    const auto shared = [](const auto&... inputs) {
      return Tier::lift([](auto by, const auto&... a) { return sphere_box_penetration<decltype(by)>(a...); },
                        inputs...);
    };
#if defined(COLLIDE_LANES)
    if constexpr (in_lanes<Tier, T>) {
      return detail::sphere_box_penetration_in_lanes(sphere, box, detail::out_of_line(shared));
    }
#endif
    return shared(sphere, box);
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

namespace contracts {

/// First order, G the largest position: an axis carries 16 eps, a coordinate in the box frame 19 eps of
/// the distance, at most 3.5 G; the way back to the world adds 15 eps of 3.5 G at most, for the length and the
/// quotient by it count as well where the contact is reached along the normal.
template <class Tier = Fast, class T = double>
constexpr Contract sphere_box_penetration() {
  return Tier::template contract<T>(
      {.backward = 128, .unit = 40, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
