/// The kernel of bounce_direction (collide/bounce_direction.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(bounce_direction)

namespace kernels {

template <class Tier, class T>
inline Direction<T> bounce_direction(const Sphere<T>& sphere, const Vec3<T>& velocity, T time, const Vec3<T>& location,
                                     const Vec3<T>& normal) {
  if constexpr (Tier::template lifts<T>) {
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_bounce(sphere.center, velocity, time, location))
        return Tier::decided_by_filter(*answer);
    }
    return COLLIDE_LIFTED(bounce_direction, sphere, velocity, time, location, normal);
  } else {
    const Vec3<T> to_center = (sphere.center - location) + velocity * time;
    const bool apart = !(to_center == Vec3<T>{});
    const Vec3<T> u = unit<Tier>(apart ? to_center : normal);
    const Vec3<T> d = unit<Tier>(velocity);
    return {with_corrected_length<T>(d - u * (T(2) * Tier::dot(d, u)))};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
