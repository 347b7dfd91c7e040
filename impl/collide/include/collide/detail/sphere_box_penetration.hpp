/// The kernel of sphere_box_penetration (collide/sphere_box_penetration.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/box_filters.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/rotation_range.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

#if defined(COLLIDE_LANES)

namespace detail {

/// The kernel of `Fast` in lanes. Calls `fallback` if the squared distance overflows or underflows.
template <class T, class Fallback>
inline Penetration<T> sphere_box_penetration_in_lanes(const Sphere<T>& sphere, const Box<T>& box,
                                                      const Fallback& fallback) {
  using L = Lanes<T>;
  using P = Pair<T>;
  using limits = std::numeric_limits<T>;
  const L center = lanes(sphere.center), middle = lanes(box.center), half = lanes(box.half);
  L q = lanes(box.orientation), norm_squared = sum_of_four(q * q);
  if (!is_in_safe_range(norm_squared.first())) {
    q = out_of_line(rescaled_lanes<T>)(box.orientation), norm_squared = sum_of_four(q * q);
    if (!is_in_safe_range(norm_squared.first())) return fallback(sphere, box);
  }
  const P radius = P::splat(sphere.radius), zero = P::splat(T(0)), one = P::first_lane(T(1));
  const P no_radius = radius * zero;  // 0, or NaN
  // The rotation matrix times |q|^2; the division by |q|^2 runs in parallel with the rotation.
  const auto frame = FrameInLanes<T>::scaled(q);
  const L inverse = broadcast_first(one / first_pair(norm_squared));
  // NaN if an argument is not finite.
  const L local = frame.into(center - middle) * inverse, away = excess(local, half) + half * broadcast_first(no_radius);
  const P distance2 = first_pair(sum_of_three(away * away)), is_outside = zero < distance2;
  const P in_range =
      (P::splat(limits::min() / limits::epsilon()) <= distance2) & (distance2 <= P::splat(limits::max() / T(16)));
  if (!holds_or_all_zero(in_range, away)) return fallback(sphere, box);

  const P distance = sqrt(distance2);
  const auto answer = [&](const P& depth, const L& outward, const P& normal_scale, const P& to_contact) COLLIDE_INLINE {
    const L overlap = broadcast_first(zero <= depth), normal = outward * broadcast_first(normal_scale),
            contact = center - outward * broadcast_first(to_contact);
    return Penetration<T>{depth.first(), to_vec3(normal & overlap), to_vec3(contact & overlap)};
  };
  if constexpr (std::same_as<T, double>) {  // in two registers the inside case costs more than a mispredicted branch
    if (distance2.first() > T(0))
      return answer(radius - distance, frame.out_of(away) * inverse, one / (zero - distance), one);
  }
  const L to_face = half - absolute(local), to_nearest_face = smallest_of_three(to_face);
  const L side = L::splat(T(1)) ^ (local & L::splat(T(-0.0)));
  const L face = and_not(first_of_three(to_face == to_nearest_face) & side, broadcast_first(is_outside));
  const L outward =
      frame.out_of(away | face) * inverse;  // from the contact to the center if that is outside (`away` is not 0 then)
  return answer(radius - distance + and_not(first_pair(to_nearest_face), is_outside), outward,
                one / (zero - (distance | and_not(one, is_outside))), select(is_outside, one, radius));
}

}  // namespace detail

#endif

namespace detail {

/// Whether the decision of the answer of `Fast` is exact. Let S and H be the sums of the magnitudes of the vector
/// between the centers and of the half extents, r the radius and u the unit roundoff. As for sphere_box_overlap, a
/// coordinate in the box's frame has an error of 20 u S, and its excess over the half extent one of 21 u S + 1 u H. So
/// the distance has an error of 38 u S + 2 u H, and 4 u of itself; inside, the distance from the nearest face has less.
/// The depth adds 1 u of the radius and the distance.
template <class T>
bool is_certain(const Penetration<T>& answer, const Sphere<T>& sphere, const Box<T>& box) {
  const T size = magnitudes(sphere.center - box.center) + magnitudes(box.half) + sphere.radius;
  return is_accurate_rotation(box.orientation) && is_moderate_size(size) &&
         detail::abs(answer.depth) > T(32) * std::numeric_limits<T>::epsilon() * size;
}

}  // namespace detail

COLLIDE_COMPILED(sphere_box_penetration)

namespace kernels {

template <class Tier, class T>
inline Penetration<T> sphere_box_penetration(const Sphere<T>& sphere, const Box<T>& box) {
  if constexpr (Tier::template lifts<T>) {
    const auto fallback = [](const auto&... inputs) { return COLLIDE_LIFTED(sphere_box_penetration, inputs...); };
#if defined(COLLIDE_LANES)
    if constexpr (in_lanes<Tier, T>) {
      return detail::sphere_box_penetration_in_lanes(sphere, box, detail::out_of_line(fallback));
    }
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_penetration(sphere, box)) return Tier::decided_by_filter(*answer);
    }
#endif
    return fallback(sphere, box);
  } else {
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
      const Vec3<T> outward =
          unit<Tier>(Vec3<T>{away[0], away[1], away[2]});  // not away / distance: a subnormal `distance` has few digits
      return {depth, -out_of_frame(axes, components(outward)), box.center + out_of_frame(axes, nearest)};
    }
    const NearestFace<T> face = nearest_face(local, half);
    const Vec3<T> normal = axes[face.axis] * -face.side;
    return {sphere.radius + face.distance, normal, sphere.center + normal * sphere.radius};
  }
}

/// The kernel of a tier that takes numbers from another one.
template <class Tier, class T>
  requires splits_answers<Tier, T>
inline Penetration<T> sphere_box_penetration(const Sphere<T>& sphere, const Box<T>& box) {
  return split_answer<Tier>([&](auto tier) { return kernels::sphere_box_penetration<decltype(tier)>(sphere, box); },
                            [&](const auto& answer) { return detail::is_certain(answer, sphere, box); });
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
