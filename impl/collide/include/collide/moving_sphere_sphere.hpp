/// When and where a moving sphere meets a fixed one.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_sphere_sphere.hpp>
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
[[nodiscard]] Impact<T> moving_sphere_sphere(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                             const Sphere<T>& fixed) noexcept(Tier::never_throws) {
  return kernels::moving_sphere_sphere<Tier>(sphere, velocity, fixed);
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
