/// The kernel of sphere_plane_penetration (collide/sphere_plane_penetration.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace kernels {

template <class Tier, class T>
inline Penetration<T> sphere_plane_penetration(const Sphere<T>& sphere, const Plane<T>& plane) {
  if constexpr (Tier::template lifts<T>) {
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_penetration(sphere, plane)) return Tier::decided_by_filter(*answer);
    }
    return Tier::lift(
        [](auto arithmetic, const auto&... a) { return kernels::sphere_plane_penetration<decltype(arithmetic)>(a...); },
        sphere, plane);
  } else {
    const T norm = length(components(plane.normal));
    const T depth = sphere.radius - (Tier::dot(plane.normal, sphere.center) + plane.offset) / norm;
    if (!(depth >= T(0))) return {depth};
    const Vec3<T> normal = plane.normal / norm;
    return {depth, normal, sphere.center - normal * sphere.radius};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
