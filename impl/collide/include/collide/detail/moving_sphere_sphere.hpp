/// The kernel of moving_sphere_sphere (collide/moving_sphere_sphere.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/ball_filter.hpp>
#include <collide/detail/contact.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(moving_sphere_sphere)

namespace kernels {

template <class Tier, class T>
inline Impact<T> moving_sphere_sphere(const Sphere<T>& sphere, const Vec3<T>& velocity, const Sphere<T>& fixed) {
  if constexpr (uses_filter<Tier, T>) {
    if (const auto answer = detail::filtered_impact(sphere, velocity, fixed)) return Tier::decided_by_filter(*answer);
  }
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(moving_sphere_sphere, sphere, velocity, fixed);
  } else {
    const T reach = sphere.radius + fixed.radius;
    const Vec3<T> from = sphere.center - fixed.center;
    const auto contact_at = [&](const T& time) {
      const Vec3<T> away = reach > T(0) ? from + velocity * time : Vec3<T>{};
      const Vec3<T> normal = detail::outward<Tier>(away, velocity);
      return detail::contact(time, fixed.center + normal * fixed.radius, normal);
    };
    const T apart = Tier::beyond_radius(from, reach);
    if (!(apart > T(0))) {
      const bool touches = apart == T(0) && Tier::dot(from, velocity) <= T(0);
      const bool overlaps = apart < T(0) && sphere.radius > T(0);
      return touches || overlaps ? contact_at(T(0)) : Impact<T>::miss();
    }
    const T time = detail::time_to_ball<Tier>(from, velocity, reach);
    return time >= T(0) ? contact_at(time) : Impact<T>::miss();
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
