/// The kernel of moving_sphere_capsule (collide/moving_sphere_capsule.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/moving_ball_capsule.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(moving_sphere_capsule)

namespace kernels {

template <class Tier, class T>
inline Impact<T> moving_sphere_capsule(const Sphere<T>& sphere, const Vec3<T>& velocity, const Capsule<T>& capsule) {
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(moving_sphere_capsule, sphere, velocity, capsule);
  } else {
    return detail::moving_ball_capsule<Tier>(sphere.center, sphere.radius, velocity, capsule);
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
