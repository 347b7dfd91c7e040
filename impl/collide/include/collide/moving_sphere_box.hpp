/// The time and place at which a moving sphere hits a box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_sphere_box.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `sphere`, moving by `velocity` per unit of time, with the solid `box`.
///
/// An overlap at the start is a contact at time 0. A touch at the start is a contact at time 0 unless the sphere moves
/// away. A sphere of radius 0 whose center starts strictly inside is a miss: it does not come from outside. The
/// location is the point of the box closest to the center at the time of contact or, for a center inside the box, the
/// closest point of its surface. A box with a half extent of 0 is a rectangle, a segment or a point.
///
/// 1. |center + velocity * time - location| == radius, except for an overlap at the start
/// 2. normal points from location to the center, or outward for a center inside; for a center on the surface it is the
///    normal of a face, with normal . velocity <= 0 unless the velocity leaves the box
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source: in the box's
/// frame the squared distance of the center is a convex, piecewise quadratic function of time; its first root is found
/// piece by piece (at most seven). A sphere of radius 0 is a point (moving_point_box).
template <class Tier = Fast, class T>
[[nodiscard]] inline Impact<T> moving_sphere_box(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                                 const Box<T>& box) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_sphere_box, TierOfDecisions<Tier>, sphere, velocity, box);
}

namespace contracts {

/// First order. An axis has an error of 16 eps (7 in each product of the quaternion, at most two of them, and the
/// sums). So a coordinate in the box's frame has an error of 19 eps of the distance, which is at most 4 G. The motion
/// to the contact and the transformation to the world add at most 12 eps of 4 G. Unit: the axes are combined with the
/// components of a unit vector.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_box() {
  return Tier::template contract<T>(
      {.backward = 128, .unit = 40, .lowest = lowest_for<T>(4), .highest = highest_for<T>(4)});
}

}  // namespace contracts
}  // namespace collide
