/// The kernel of slide_direction (collide/slide_direction.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(slide_direction)

namespace kernels {

template <class Tier, class T>
inline Direction<T> slide_direction(const Sphere<T>& sphere, const Vec3<T>& velocity, T time, const Vec3<T>& location) {
  if constexpr (Tier::template lifts<T>) {
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_slide(sphere.center, velocity, time, location))
        return Tier::decided_by_filter(*answer);
    }
    return COLLIDE_LIFTED(slide_direction, sphere, velocity, time, location);
  } else {
    const Vec3<T> to_center = (sphere.center - location) + velocity * time;
    const Vec3<T> d = unit<Tier>(velocity);
    if (to_center == Vec3<T>{}) return {with_corrected_length(d)};
    const Vec3<T> u = unit<Tier>(to_center), slid = Tier::cross(u, Tier::cross(d, u));
    if constexpr (MachineNumber<T>) {
      const T cosine = Tier::dot(d, u), cosine2 = cosine * cosine;
      return {cosine2 <= T(0.25) ? with_corrected_length(slid, cosine2) : slid};
    }
    return {slid};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
