/// The kernel of moving_point_sphere (collide/moving_point_sphere.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/ball_filter.hpp>
#include <collide/detail/contact.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

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
    return COLLIDE_LIFTED(moving_point_sphere, point, velocity, sphere, solid);
  } else {
    using detail::sqrt;
    const Vec3<T> m = point - sphere.center;
    const T outside = Tier::beyond_radius(m, sphere.radius);
    const bool starts_in = outside <= T(0);
    if (starts_in && solid) return detail::contact(T(0), point, detail::outward<Tier>(m, velocity));
    const T speed2 = Tier::dot(velocity, velocity);
    if (!(speed2 > T(0))) return Impact<T>::miss();
    const T nearest = -Tier::dot(m, velocity) / speed2;  // time of the closest approach
    if (!starts_in && !(nearest > T(0))) return Impact<T>::miss();
    const Vec3<T> offset = m + velocity * nearest;
    const T chord2 = -Tier::beyond_radius(offset, sphere.radius);
    if (!(chord2 >= T(0)) && !starts_in) return Impact<T>::miss();
    const T half_chord = sqrt(positive_part(chord2)) / sqrt(speed2);  // in units of time
    // Near a tangent, the textbook quotient outside / (nearest + half_chord) loses the digits that the square of the
    // radius loses. This difference has an error of 1 eps of the distance to the closest approach.
    const T time = positive_part(starts_in ? nearest + half_chord : nearest - half_chord);
    const Vec3<T> displacement = velocity * time;
    const Vec3<T> away = sphere.radius > T(0) ? m + displacement : Vec3<T>{};
    return detail::contact(time, point + displacement, detail::outward<Tier>(away, velocity));
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
