/// The depth of a sphere behind a plane.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/sphere_plane_penetration.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The depth of the deepest point of `sphere` behind `plane`: radius - (n . center + offset) / |n|, where n is the
/// plane's normal. The answer's normal is n / |n|; the contact is the deepest point of the sphere. A touching sphere
/// has depth 0. For a sphere in front only the negative depth is given; normal and contact are zero.
///
/// 1. depth >= 0 exactly when the ball has a point on the plane or behind it
/// 2. contact == center - normal * radius
/// 3. moving the sphere by depth * normal makes it touch the plane from the front
///
/// Scaling n and offset by the same factor changes nothing: both describe one plane. Units: lengths. Never fails.
/// Non-finite input: a depth of NaN. Source: the height of the center above the plane.
template <class Tier = Fast, class T>
[[nodiscard]] inline Penetration<T> sphere_plane_penetration(const Sphere<T>& sphere,
                                                             const Plane<T>& plane) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(sphere_plane_penetration, Tier, sphere, plane);
}

namespace contracts {

/// First order. The dot product has an error of 4 eps of |n| |center|, for which moving the center accounts, and 1 eps
/// of the offset. The norm has an error of 3 eps and the quotient 1 eps of the distance, for which changing n and the
/// offset accounts. Depth and contact have an error of 2 eps each of the center and the radius.
template <class Tier = Fast, class T = double>
constexpr Contract sphere_plane_penetration() {
  return Tier::template contract<T>(
      {.backward = 16, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
