/// Whether a moving sphere touches a box within a time.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_sphere_passes_box.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether `sphere`, moving by `velocity` per unit of time, touches or overlaps the solid `box` at some time
/// from 0 to `limit`, both included; `limit` may be +infinity. A touch at the start counts, also of a
/// sphere that leaves.
///
/// 1. yes exactly when the distance from the box to the segment of the center's motion is at most the radius
///
/// Source: in the box's frame the squared distance of the center is a convex function of time, whose slope
/// is linear between the at most six times at which a coordinate crosses a face plane; it is least where the
/// slope crosses zero, or at an end.
template <class Tier = Fast, class T>
[[nodiscard]] Decision<T> moving_sphere_passes_box(const Sphere<T>& sphere, const Vec3<T>& velocity, const Box<T>& box,
                                                   T limit) noexcept(Tier::never_throws) {
  return kernels::moving_sphere_passes_box<Tier>(sphere, velocity, box, limit);
}

namespace contracts {

/// First order, G the largest position: a coordinate in the box frame carries 19 eps of the distance, at
/// most 4 G; one at the nearest time 3 eps more, and the distance itself 3 eps. An error of that time is
/// of no first order where the slope is zero, and 2 eps of the limit at its end.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_passes_box() {
  return Tier::template contract<T>({.backward = 128, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
