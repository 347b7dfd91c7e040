/// The kernel of sphere_sphere_penetration (collide/sphere_sphere_penetration.hpp).
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
inline Penetration<T> sphere_sphere_penetration(const Sphere<T>& sphere1, const Sphere<T>& sphere2) {
  if constexpr (Tier::template lifts<T>) {
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_penetration(sphere1, sphere2)) return Tier::decided_by_filter(*answer);
    }
    return Tier::lift([](auto arithmetic,
                         const auto&... a) { return kernels::sphere_sphere_penetration<decltype(arithmetic)>(a...); },
                      sphere1, sphere2);
  } else {
    const Vec3<T> between = sphere2.center - sphere1.center;
    const T distance = length(components(between));
    const T depth = (sphere1.radius + sphere2.radius) - distance;
    if (!(depth >= T(0))) return {depth};
    const Vec3<T> normal = distance > T(0) ? unit<Tier>(between) : Vec3<T>{T(1), T(0), T(0)};
    return {depth, normal, sphere1.center + normal * sphere1.radius};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
