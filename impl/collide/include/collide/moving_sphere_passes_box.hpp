/// Whether a moving sphere touches a box within a time.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_sphere_passes_box.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// Whether `sphere`, moving by `velocity` per unit of time, touches or overlaps the solid `box` at some time from 0 to
/// `limit`, both included. `limit` is not negative and may be +infinity. A touch at the start counts, even if the
/// sphere moves away.
///
/// 1. yes() exactly when the distance between the box and the path of the center is at most the radius
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: no. Source: in the box's frame
/// the squared distance of the center is a convex function of time. Its slope is linear between the at most six times
/// at which a coordinate crosses a face plane. The distance is least where the slope crosses zero, or at an end of the
/// time interval.
template <class Tier = Fast, class T>
[[nodiscard]] inline Decision<T> moving_sphere_passes_box(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                                          const Box<T>& box, T limit) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_sphere_passes_box, TierOfDecisions<Tier>, sphere, velocity, box, limit);
}

namespace contracts {

/// First order. A coordinate in the box's frame has an error of 19 eps of the distance, at most 4 G. A coordinate at
/// the time of the least distance has 3 eps more, and the distance itself 3 eps. An error in that time has no
/// first-order effect, since the slope is zero there; at the limit it is 2 eps of the limit.
template <class Tier = Fast, class T = double>
constexpr Contract moving_sphere_passes_box() {
  return Tier::template contract<T>({.backward = 128, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
