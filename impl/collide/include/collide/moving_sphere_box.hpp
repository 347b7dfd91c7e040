/// When and where a moving sphere meets a box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_sphere_box.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `sphere`, moving by `velocity` per unit of time, with the solid `box`.
///
/// An overlap at the start is a contact at time 0; so is a touch at the start unless the sphere
/// leaves. A sphere of radius 0 whose center starts strictly inside never comes from outside: a miss.
/// Location is the point of the box nearest to the center at that time or, for a center inside the
/// box, the nearest point of its surface.
///
/// 1. |center + velocity * time - location| == radius, but for an overlap at the start
/// 2. normal points from location to the center, or outward for a center inside; for a center on the surface it is that
///    of a face, and not along the motion unless that leaves the box
///
/// Source: in the box's frame the squared distance of the center is a convex piecewise quadratic of
/// time; its first root is found piece by piece (at most seven). A sphere of radius 0 is a point (moving_point_box).
template <class Tier = Fast, class T>
[[nodiscard]] Impact<T> moving_sphere_box(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                          const Box<T>& box) noexcept(Tier::never_throws) {
  return kernels::moving_sphere_box<Tier>(sphere, velocity, box);
}

namespace contracts {

/// First order, G the largest position: an axis carries 16 eps (7 in each product of the quaternion, at
/// most two of them, and the sums), so a coordinate in the box frame 19 eps of the distance, which is at
/// most 4 G; the walk to the contact and the way back to the world add as much as 12 eps of 4 G. Unit:
/// the axes are combined by a unit vector.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_box() {
  return Tier::template contract<T>(
      {.backward = 128, .unit = 40, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
