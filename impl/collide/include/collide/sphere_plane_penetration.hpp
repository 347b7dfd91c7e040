/// How deep a sphere reaches behind a plane.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/sphere_plane_penetration.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The depth of the deepest point of `sphere` behind `plane`: radius - (n . center + offset) / |n|, n the
/// plane's normal. The normal is n / |n|, the contact the sphere's deepest point. Apart: only the depth,
/// negative, is given.
///
/// 1. depth >= 0 exactly when the ball has a point on the plane or behind it
/// 2. contact == center - normal * radius
/// 3. moving the sphere by depth * normal makes it touch the plane from the front
///
/// The lengths of n and offset play a part only together: they are one plane.
template <class Tier = Fast, class T>
[[nodiscard]] Penetration<T> sphere_plane_penetration(const Sphere<T>& sphere,
                                                      const Plane<T>& plane) noexcept(Tier::never_throws) {
  return kernels::sphere_plane_penetration<Tier>(sphere, plane);
}

namespace contracts {

/// First order: the dot product carries 4 eps of |n| |center|, which moving the center explains, and 1 eps
/// of the offset; the norm 3 eps and the quotient 1 eps of the distance, a change of n and the offset;
/// depth and contact 2 eps each of the center and the radius.
template <class Tier = Fast, class T = double>
constexpr Contract sphere_plane_penetration() {
  return Tier::template contract<T>(
      {.backward = 16, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
