/// How deep a box reaches behind a plane, with every corner that does.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/box_plane_penetration.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The depth of the deepest point of `box` behind `plane`, that of a corner: -(n . corner + offset) / |n|, n
/// the plane's normal. The normal is n / |n|; the contacts are all corners on the plane or behind it. Apart:
/// only the depth, negative, is given.
///
/// 1. depth >= 0 exactly when some corner is a contact
/// 2. moving the box by depth * normal leaves it touching the plane from the front
///
/// A box without an extent along some axis has corners that coincide; each counts.
template <class Tier = Fast, class T>
[[nodiscard]] CornerContacts<T> box_plane_penetration(const Box<T>& box,
                                                      const Plane<T>& plane) noexcept(Tier::never_throws) {
  return kernels::box_plane_penetration<Tier>(box, plane);
}

namespace contracts {

/// First order: an axis carries 16 eps and a side 1 eps more, of the half extents or by turning the box; a
/// corner is the sum of four such, 3 eps of each more. Its height above the plane 4 eps of |n| times the
/// center and each side, 3 eps of the sum, which moving the center, the half extents and the offset
/// explains; the norm and the quotient 4 eps.
template <class Tier = Fast, class T = double>
constexpr Contract box_plane_penetration() {
  return Tier::template contract<T>(
      {.backward = 64, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
