/// The penetration depth of a sphere and a box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/sphere_box_penetration.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The penetration depth of `sphere` and the solid `box`, with one contact. Touching shapes have depth 0.
///
/// Center outside: depth = radius - distance; the contact is the point of the box closest to the center; the normal
/// points from the center to the contact. Center inside or on the surface: depth = radius + distance to the closest
/// face; the contact is the deepest point of the sphere; the normal points into the box. Apart: only the negative depth
/// is given; normal and contact are zero.
///
/// 1. depth >= 0 exactly when the closed sets meet
/// 2. moving the sphere by -depth * normal makes them touch
///
/// Units: lengths. Never fails. Non-finite input: a depth of NaN. Source: in the box's frame, the excess of each
/// coordinate over the half extents.
template <class Tier = Fast, class T>
[[nodiscard]] inline Penetration<T> sphere_box_penetration(const Sphere<T>& sphere,
                                                           const Box<T>& box) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(sphere_box_penetration, Tier, sphere, box);
}

namespace contracts {

/// First order. An axis has an error of 16 eps. A coordinate in the box's frame has an error of 19 eps of the distance,
/// at most 3.5 G. The transformation to the world adds at most 15 eps of 3.5 G: where the contact is reached along the
/// normal, the errors of the length and of the quotient by it count as well.
template <class Tier = Fast, class T = double>
constexpr Contract sphere_box_penetration() {
  return Tier::template contract<T>(
      {.backward = 128, .unit = 40, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
