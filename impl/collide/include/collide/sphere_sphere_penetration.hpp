/// The penetration depth of two spheres.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/sphere_sphere_penetration.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The penetration depth of two balls, with one contact: depth = radius1 + radius2 - distance of the centers. The
/// normal points from center 1 to center 2; if the centers coincide it is any unit vector. The contact is the point of
/// sphere 1 deepest in sphere 2. Touching balls have depth 0. Apart: only the negative depth is given; normal and
/// contact are zero.
///
/// 1. depth >= 0 exactly when the closed balls meet
/// 2. contact == center1 + normal * radius1
/// 3. moving sphere 2 by depth * normal makes them touch
///
/// Units: lengths. Never fails. Non-finite input: a depth of NaN. Source: the definition above.
template <class Tier = Fast, class T>
[[nodiscard]] inline Penetration<T> sphere_sphere_penetration(const Sphere<T>& sphere1,
                                                              const Sphere<T>& sphere2) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(sphere_sphere_penetration, Tier, sphere1, sphere2);
}

namespace contracts {

/// First order. The vector between the centers has an error of 1 eps of 2 G, its length 3 eps of at most 4 G; moving
/// the centers accounts for both. The sum of the radii, the depth and the contact have an error of 1 eps each of as
/// much. The normal has an error of 4 eps, times the radius; moving the centers and changing the radius accounts for
/// it.
template <class Tier = Fast, class T = double>
constexpr Contract sphere_sphere_penetration() {
  return Tier::template contract<T>(
      {.backward = 24, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
