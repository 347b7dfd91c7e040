/// The kernel of moving_sphere_passes_sphere (collide/moving_sphere_passes_sphere.hpp).
#pragma once

#include <optional>

#include <collide/answers.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(moving_sphere_passes_sphere)

namespace kernels {

template <class Tier, class T>
inline Decision<T> moving_sphere_passes_sphere(const Sphere<T>& sphere, const Vec3<T>& velocity, const Sphere<T>& fixed,
                                               const T& limit) {
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(moving_sphere_passes_sphere, sphere, velocity, fixed, limit);
  } else {
    const T reach = sphere.radius + fixed.radius;
    if (!(limit >= T(0))) return {false};
    const Vec3<T> from = sphere.center - fixed.center;
    const T closing = -Tier::dot(from, velocity);
    Vec3<T> offset = from;
    if (closing > T(0)) {
      const T nearest = smaller(T(closing / Tier::dot(velocity, velocity)), limit);  // time of the closest approach
      offset = from + velocity * nearest;
    }
    return {-Tier::beyond_radius(offset, reach) >= T(0)};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
