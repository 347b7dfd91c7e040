/// When and where a moving sphere meets a capsule.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_sphere_capsule.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The first contact of `sphere`, moving by `velocity` per unit of time, with the solid `capsule`.
///
/// An overlap at the start is a contact at time 0; so is a touch at the start unless the sphere
/// leaves. A sphere of radius 0 whose center starts strictly inside never comes from outside: a miss.
/// Location is the point of the capsule nearest to the center at that time or, for a center inside the
/// capsule, the nearest point of its surface.
///
/// 1. |center + velocity * time - location| == radius, but for an overlap at the start
/// 2. normal points from the capsule's axis to the center; for a center on the axis it is at a right angle to it, and
///    not along the motion
///
/// Source: the center meets a capsule with both radii. In the plane across the axis the endless tube is a
/// circle; where the center enters it beyond an end, the ball around that end counts.
template <class Tier = Fast, class T>
[[nodiscard]] Impact<T> moving_sphere_capsule(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                              const Capsule<T>& capsule) noexcept(Tier::never_throws) {
  return kernels::moving_sphere_capsule<Tier>(sphere, velocity, capsule);
}

namespace contracts {

/// First order, G the largest position: the axis carries 4 eps, a coordinate along it 8 eps of a distance of
/// at most 4 G, what is left beside it 10 eps; the closest approach 9 eps of the same distance, its square
/// and the sum of the radii 5 eps more; the way back along the axis 9 eps of 2 G.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_capsule() {
  return Tier::template contract<T>(
      {.backward = 128, .unit = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
