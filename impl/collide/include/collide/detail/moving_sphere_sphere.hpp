/// The kernel of moving_sphere_sphere (collide/moving_sphere_sphere.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/ball_filter.hpp>
#include <collide/detail/contact.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// The contact of a moving sphere with another one at `time`.
template <class Tier, class T>
inline Impact<T> contact_of_spheres(const Sphere<T>& sphere, const Vec3<T>& velocity, const Sphere<T>& fixed,
                                    const T& time) {
  const bool points = !(sphere.radius + fixed.radius > T(0));
  const Vec3<T> away = points ? Vec3<T>{} : (sphere.center - fixed.center) + velocity * time;
  const Vec3<T> normal = outward<Tier>(away, velocity);
  return contact(time, fixed.center + normal * fixed.radius, normal);
}

/// The contact of a sphere that starts in contact with the other one; `apart` is negative where they overlap.
template <class Tier, class T>
COLLIDE_COLD Impact<T> moving_sphere_from_contact(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                                  const Sphere<T>& fixed, const T& apart) {
  if constexpr (MachineNumber<T>) {  // apart, a number that is not finite makes the chord infinite or NaN
    if (!all_finite(sphere, velocity, fixed)) return Impact<T>::miss();
  }
  const bool touches = apart == T(0) && Tier::dot(sphere.center - fixed.center, velocity) <= T(0);
  const bool overlaps = apart < T(0) && sphere.radius > T(0);
  return touches || overlaps ? contact_of_spheres<Tier>(sphere, velocity, fixed, T(0)) : Impact<T>::miss();
}

}  // namespace detail

COLLIDE_COMPILED(moving_sphere_sphere)

namespace kernels {

template <class Tier, class T>
inline Impact<T> moving_sphere_sphere(const Sphere<T>& sphere, const Vec3<T>& velocity, const Sphere<T>& fixed) {
  if constexpr (uses_filter<Tier, T>) {
    if (const auto answer = detail::filtered_impact(sphere, velocity, fixed)) return Tier::decided_by_filter(*answer);
  }
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift(YesIfFinite{COLLIDE_KERNEL(moving_sphere_sphere)}, sphere, velocity, fixed);
  } else {
    const T reach = sphere.radius + fixed.radius;
    const Vec3<T> from = sphere.center - fixed.center;
    const T apart = Tier::beyond_radius(from, reach);
    if (!(apart > T(0))) return detail::moving_sphere_from_contact<Tier>(sphere, velocity, fixed, apart);
    const T time = detail::time_to_ball<Tier>(from, velocity, reach);
    return time >= T(0) ? detail::contact_of_spheres<Tier>(sphere, velocity, fixed, time) : Impact<T>::miss();
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
