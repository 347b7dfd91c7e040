/// How deep a sphere overlaps a box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/sphere_box_penetration.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The penetration depth of `sphere` and the solid `box`, with one contact.
///
/// Center outside: depth = radius - distance, the contact is the point of the box nearest to the
/// center, the normal points from the center to it. Center inside or on the surface: depth = radius +
/// distance to the nearest face, the contact is the sphere's deepest point, the normal points into
/// the box. Apart: only the depth, negative, is given.
///
/// 1. depth >= 0 exactly when the closed sets meet
/// 2. moving the sphere by -depth * normal makes them touch
template <class Tier = Fast, class T>
[[nodiscard]] Penetration<T> sphere_box_penetration(const Sphere<T>& sphere,
                                                    const Box<T>& box) noexcept(Tier::never_throws) {
  return kernels::sphere_box_penetration<Tier>(sphere, box);
}

namespace contracts {

/// First order, G the largest position: an axis carries 16 eps, a coordinate in the box frame 19 eps of
/// the distance, at most 3.5 G; the way back to the world adds 15 eps of 3.5 G at most, for the length and the
/// quotient by it count as well where the contact is reached along the normal.
template <class Tier = Fast, class T = double>
constexpr Contract sphere_box_penetration() {
  return Tier::template contract<T>(
      {.backward = 128, .unit = 40, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
