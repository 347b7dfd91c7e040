/// The kernel of sphere_sphere_penetration (collide/sphere_sphere_penetration.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/contact.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// Whether the decision of the answer of `Fast` is exact. The distance has an error of 5 u of itself (u is the unit
/// roundoff), the sum of the radii one of 1 u, and the depth one of 1 u of both. The distance is at most the sum of the
/// magnitudes of the vector between the centers.
template <class T>
bool is_certain(const Penetration<T>& answer, const Sphere<T>& sphere1, const Sphere<T>& sphere2) {
  const T size = magnitudes(sphere2.center - sphere1.center) + sphere1.radius + sphere2.radius;
  return is_moderate_size(size) && detail::abs(answer.depth) > T(8) * std::numeric_limits<T>::epsilon() * size;
}

#if defined(COLLIDE_LANES)

/// The kernel of `Fast` in lanes: the formulas of the shared kernel, for spheres that overlap and others alike. Calls
/// `fallback` where the distance needs scaling and for input that is not finite.
template <class T, class Fallback>
inline Penetration<T> sphere_sphere_penetration_in_lanes(const Sphere<T>& sphere1, const Sphere<T>& sphere2,
                                                         const Fallback& fallback) {
  using L = Lanes<T>;
  using P = Pair<T>;
  const L ball1 = lanes(sphere1), ball2 = lanes(sphere2), between = ball2 - ball1;
  const P distance2 = first_pair(sum_of_three(between * between)), distance = sqrt(distance2);
  const P depth = P::splat(sphere1.radius + sphere2.radius) - distance, overlap = P::splat(T(0)) <= depth;
  if (!(needs_no_scaling(distance2.first()) && all_four(are_finite(ball1, ball2)))) return fallback(sphere1, sphere2);
  const L normal = between / broadcast_first(distance), contact = ball1 + normal * L::splat(sphere1.radius);
  const L yes = broadcast_first(overlap);
  return answer_from_lanes<Penetration<T>>(depth, normal & yes, contact & yes);
}

#endif

}  // namespace detail

COLLIDE_COMPILED(sphere_sphere_penetration)

namespace kernels {

template <class Tier, class T>
inline Penetration<T> sphere_sphere_penetration(const Sphere<T>& sphere1, const Sphere<T>& sphere2) {
  if constexpr (Tier::template lifts<T>) {
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_penetration(sphere1, sphere2)) return Tier::decided_by_filter(*answer);
    }
    const auto fallback = [](const auto&... inputs) { return COLLIDE_LIFTED(sphere_sphere_penetration, inputs...); };
#if defined(COLLIDE_LANES)
    if constexpr (in_lanes<Tier, T>) {
      return detail::sphere_sphere_penetration_in_lanes(sphere1, sphere2, detail::out_of_line(fallback));
    }
#endif
    return fallback(sphere1, sphere2);
  } else {
    const Vec3<T> between = sphere2.center - sphere1.center;
    const T distance = length(components(between));
    const T depth = (sphere1.radius + sphere2.radius) - distance;
    if (!(depth >= T(0))) return {depth};
    const Vec3<T> normal = distance > T(0) ? unit<Tier>(between) : Vec3<T>{T(1), T(0), T(0)};
    return {depth, normal, sphere1.center + normal * sphere1.radius};
  }
}

/// The kernel of a tier that takes numbers from another one.
template <class Tier, class T>
  requires splits_answers<Tier, T>
inline Penetration<T> sphere_sphere_penetration(const Sphere<T>& sphere1, const Sphere<T>& sphere2) {
  return split_answer<Tier>(
      [&](auto tier) { return kernels::sphere_sphere_penetration<decltype(tier)>(sphere1, sphere2); },
      [&](const auto& answer) { return detail::is_certain(answer, sphere1, sphere2); });
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
