/// The kernel of sphere_plane_penetration (collide/sphere_plane_penetration.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// Whether the decision of the answer of `Fast` is exact. Let B be the sum of the magnitudes of the terms of the height
/// times the length of the normal. That height has an error of 4 u B (u is the unit roundoff), the length one of 4 u of
/// itself, the quotient 1 u more, and the depth 1 u of the radius and the height. So the depth has an error of 10 u of
/// B by the length, and of the radius. The length is at least the largest number of the normal.
template <class T>
bool is_certain(const Penetration<T>& answer, const Sphere<T>& sphere, const Plane<T>& plane) {
  const Vec3<T>&n = plane.normal, &center = sphere.center;
  const T terms = magnitudes(Vec3<T>{n.x * center.x, n.y * center.y, n.z * center.z}) + detail::abs(plane.offset);
  const T steepness = largest_magnitude(n), size = terms + sphere.radius * steepness;
  return is_moderate_size(steepness) && is_moderate_size(size) &&
         detail::abs(answer.depth) * steepness > T(16) * std::numeric_limits<T>::epsilon() * size;
}

}  // namespace detail

COLLIDE_COMPILED(sphere_plane_penetration)

namespace kernels {

template <class Tier, class T>
inline Penetration<T> sphere_plane_penetration(const Sphere<T>& sphere, const Plane<T>& plane) {
  if constexpr (Tier::template lifts<T>) {
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_penetration(sphere, plane)) return Tier::decided_by_filter(*answer);
    }
    return COLLIDE_LIFTED(sphere_plane_penetration, sphere, plane);
  } else {
    const T norm = length(components(plane.normal));
    const T depth = sphere.radius - (Tier::dot(plane.normal, sphere.center) + plane.offset) / norm;
    if (!(depth >= T(0))) return {depth};
    const Vec3<T> normal = plane.normal / norm;
    return {depth, normal, sphere.center - normal * sphere.radius};
  }
}

/// The kernel of a tier that takes numbers from another one.
template <class Tier, class T>
  requires splits_answers<Tier, T>
inline Penetration<T> sphere_plane_penetration(const Sphere<T>& sphere, const Plane<T>& plane) {
  return split_answer<Tier>([&](auto tier) { return kernels::sphere_plane_penetration<decltype(tier)>(sphere, plane); },
                            [&](const auto& answer) { return detail::is_certain(answer, sphere, plane); });
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
