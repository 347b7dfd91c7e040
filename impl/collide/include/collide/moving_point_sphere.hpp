/// When and where a moving point meets a sphere.
#pragma once

#include <collide/answers.hpp>
#include <collide/contact.hpp>
#include <collide/contract.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `point`, moving by `velocity` per unit of time, with `sphere`.
///
/// Solid: a start inside or on the surface is a contact at time 0, located at the point, the normal
/// from the center. Not solid: such a start gives the exit, the last time at which the point is on
/// the surface. From outside: the entry; touching counts. Zero velocity is a miss, but for a solid
/// start inside.
///
/// 1. |location - center| == radius, but for a solid start inside
/// 2. normal == (location - center) / |location - center|; at the center, of a solid or a sphere of radius 0, it is
///    against the motion
///
/// Source: the discriminant as the distance of the center from the line of motion (Haines, Guenther,
/// Akenine-Moeller, Precision Improvements for Ray/Sphere Intersection, 2019).
template <class Tier = Fast, class T>
Impact<T> moving_point_sphere(const Vec3<T>& point, const Vec3<T>& velocity, const Sphere<T>& sphere,
                              bool solid) noexcept {
  if constexpr (looks_first<Tier, T>) {
    const Vec3<double> from = detail::in_double(point) - detail::in_double(sphere.center);
    if (detail::surely_misses(from, detail::in_double(velocity), double(sphere.radius)))
      return Tier::sure(Impact<T>::miss());
  }
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return moving_point_sphere<decltype(by)>(a...); }, point,
                      velocity, sphere, solid);
  }
  using std::sqrt;
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
  const T half_chord = sqrt(not_negative(chord2)) / sqrt(speed2);  // in units of time
  // Near a tangent the quotient of the textbooks, outside / (nearest + half_chord), loses what the
  // square of the radius loses; this difference loses 1 eps of the way to the closest approach.
  const T time = not_negative(starts_in ? nearest + half_chord : nearest - half_chord);
  const Vec3<T> way = velocity * time;
  const Vec3<T> away = sphere.radius > T(0) ? m + way : Vec3<T>{};
  return detail::contact(time, point + way, detail::outward<Tier>(away, velocity));
}

namespace contracts {

/// First order, G the largest position: center to point is known to 2 eps G per axis; the closest
/// approach carries 9 eps of that distance (at most 4 G), its square and the radius 4 eps more; the
/// location 2 eps of 4 G.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_sphere() {
  return Tier::template contract<T>(
      {.backward = 64, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
