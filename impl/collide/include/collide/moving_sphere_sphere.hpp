/// When and where a moving sphere meets a fixed one.
#pragma once

#include <collide/answers.hpp>
#include <collide/contact.hpp>
#include <collide/contract.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `sphere`, moving by `velocity` per unit of time, with the solid sphere `fixed`.
///
/// An overlap at the start is a contact at time 0; so is a touch at the start unless the sphere
/// leaves. A sphere of radius 0 whose center starts strictly inside never comes from outside: a miss.
/// Location is the point of the fixed sphere's surface nearest to the moving center at that time.
///
/// 1. |location - fixed.center| == fixed.radius
/// 2. normal points from the fixed center to the moving one; where they are the same it is against the motion
///
/// Source: a point that meets a ball with both radii.
template <class Tier = Fast, class T>
Impact<T> moving_sphere_sphere(const Sphere<T>& sphere, const Vec3<T>& velocity, const Sphere<T>& fixed) noexcept {
  if constexpr (looks_first<Tier, T>) {
    const Vec3<double> from = detail::in_double(sphere.center) - detail::in_double(fixed.center);
    if (detail::surely_misses(from, detail::in_double(velocity), double(sphere.radius) + double(fixed.radius))) {
      return Tier::sure(Impact<T>::miss());
    }
  }
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return moving_sphere_sphere<decltype(by)>(a...); }, sphere,
                      velocity, fixed);
  }
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

namespace contracts {

/// First order, G the largest position: center to center is known to 2 eps G per axis; the closest approach
/// carries 9 eps of that distance (at most 4 G), its square and the sum of the radii 5 eps more; the
/// location 2 eps of 4 G.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_sphere() {
  return Tier::template contract<T>(
      {.backward = 64, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
