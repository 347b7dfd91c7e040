/// The kernel of moving_point_sphere (collide/moving_point_sphere.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/ball_filter.hpp>
#include <collide/detail/contact.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// The contact of a moving point with a sphere's surface at `time`.
template <class Tier, class T>
inline Impact<T> contact_on_sphere(const Vec3<T>& point, const Vec3<T>& velocity, const Sphere<T>& sphere,
                                   const T& time) {
  const Vec3<T> displacement = velocity * time;
  const Vec3<T> away = sphere.radius > T(0) ? (point - sphere.center) + displacement : Vec3<T>{};
  return contact(time, point + displacement, outward<Tier>(away, velocity));
}

/// The contact of a point that starts inside the sphere or on it.
template <class Tier, class T>
COLLIDE_COLD Impact<T> moving_point_from_inside(const Vec3<T>& point, const Vec3<T>& velocity, const Sphere<T>& sphere,
                                                bool solid) {
  if constexpr (MachineNumber<T>) {  // outside, a number that is not finite makes the chord infinite or NaN
    if (!all_finite(point, velocity, sphere)) return Impact<T>::miss();
  }
  const Vec3<T> m = point - sphere.center;
  if (solid) return contact(T(0), point, outward<Tier>(m, velocity));
  const T speed2 = Tier::dot(velocity, velocity);
  if (!(speed2 > T(0))) return Impact<T>::miss();
  return contact_on_sphere<Tier>(point, velocity, sphere, time_out_of_ball<Tier>(m, velocity, speed2, sphere.radius));
}

}  // namespace detail

COLLIDE_COMPILED(moving_point_sphere)

namespace kernels {

template <class Tier, class T>
inline Impact<T> moving_point_sphere(const Vec3<T>& point, const Vec3<T>& velocity, const Sphere<T>& sphere,
                                     bool solid) {
  if constexpr (uses_filter<Tier, T>) {
    if (const auto answer = detail::filtered_impact(point, velocity, sphere, solid))
      return Tier::decided_by_filter(*answer);
  }
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift(YesIfFinite{COLLIDE_KERNEL(moving_point_sphere)}, point, velocity, sphere, solid);
  } else {
    const Vec3<T> m = point - sphere.center;
    if (Tier::beyond_radius(m, sphere.radius) <= T(0))
      return detail::moving_point_from_inside<Tier>(point, velocity, sphere, solid);
    const T time = detail::time_to_ball<Tier>(m, velocity, sphere.radius);
    return time >= T(0) ? detail::contact_on_sphere<Tier>(point, velocity, sphere, time) : Impact<T>::miss();
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
