/// How deep a box reaches behind a plane, with every corner that does.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/frame.hpp>
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
CornerContacts<T> box_plane_penetration(const Box<T>& box, const Plane<T>& plane) noexcept {
  if constexpr (Tier::template lifts<T>) {
    return Tier::lift([](auto by, const auto&... a) { return box_plane_penetration<decltype(by)>(a...); }, box, plane);
  }
  const Axes<T> axes = axes_of(box.orientation);
  const std::array<Vec3<T>, 3> side{axes[0] * box.half.x, axes[1] * box.half.y, axes[2] * box.half.z};
  const T center = Tier::dot(plane.normal, box.center) + plane.offset;
  const std::array<T, 3> reach = into_frame<Tier>(side, plane.normal);
  const auto signed_sum = [](int corner, const auto& middle, const auto& sides) {
    const auto x = (corner & 1) != 0 ? middle + sides[0] : middle - sides[0];
    const auto y = (corner & 2) != 0 ? x + sides[1] : x - sides[1];
    return (corner & 4) != 0 ? y + sides[2] : y - sides[2];
  };
  std::array<T, 8> height;
  for (int i = 0; i < 8; ++i) height[i] = signed_sum(i, center, reach);
  T lowest = height[0];
  for (int i = 1; i < 8; ++i) lowest = smaller(lowest, height[i]);

  const T norm = length(components(plane.normal));
  CornerContacts<T> contacts;
  contacts.depth = -lowest / norm;
  if (!(contacts.depth >= T(0))) return contacts;
  contacts.normal = plane.normal / norm;
  for (int i = 0; i < 8; ++i) {
    if (height[i] <= T(0)) contacts.corners[i] = {T(1), signed_sum(i, box.center, side)};
  }
  return contacts;
}

namespace inputs {
template <class T>
struct box_plane_penetration {
  Box<T> box{};
  Plane<T> plane{};

  static constexpr auto members() {
    return std::tuple(member("box", &box_plane_penetration::box), member("plane", &box_plane_penetration::plane));
  }
  template <class Tier>
  auto ask() const noexcept {
    return collide::box_plane_penetration<Tier>(box, plane);
  }

  /// First order: an axis carries 16 eps and a side 1 eps more, of the half extents or by turning the box; a
  /// corner is the sum of four such, 3 eps of each more. Its height above the plane 4 eps of |n| times the
  /// center and each side, 3 eps of the sum, which moving the center, the half extents and the offset
  /// explains; the norm and the quotient 4 eps.
  static constexpr Contract contract(Fast) {
    return {.backward = 64, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)};
  }
};
}  // namespace inputs
}  // namespace collide
