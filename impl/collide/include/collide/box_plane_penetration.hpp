/// The depth of a box behind a plane, with all corners that are contacts.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/box_plane_penetration.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The depth of the deepest point of `box` behind `plane`. That point is a corner, with depth -(n . corner +
/// offset) / |n|, where n is the plane's normal. The answer's normal is n / |n|; its contacts are all corners on the
/// plane or behind it. Touching is a contact with depth 0. For a box in front only the negative depth is given; all
/// other numbers are zero.
///
/// 1. depth >= 0 exactly when some corner is a contact
/// 2. moving the box by depth * normal leaves it touching the plane from the front
///
/// A box with a half extent of 0 has corners that coincide; each counts. Units: lengths. Never fails. Non-finite input:
/// a depth of NaN. Source: the heights of the corners are sums of the center's height and the signed heights of the
/// half axes.
template <class Tier = Fast, class T>
[[nodiscard]] inline CornerContacts<T> box_plane_penetration(const Box<T>& box,
                                                             const Plane<T>& plane) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(box_plane_penetration, Tier, box, plane);
}

namespace contracts {

/// First order. An axis has an error of 16 eps and a scaled half axis 1 eps more; changing the half extents or rotating
/// the box accounts for both. A corner is a sum of four such terms, with 3 eps more of each. Its height above the plane
/// has an error of 4 eps of |n| times the center and each half axis, and 3 eps of the sum; moving the center, the half
/// extents and the offset accounts for it. The norm and the quotient have an error of 4 eps.
template <class Tier = Fast, class T = double>
constexpr Contract box_plane_penetration() {
  return Tier::template contract<T>(
      {.backward = 64, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
