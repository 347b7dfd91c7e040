/// The times at which a moving point is in a box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_span_box.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The times t >= 0 at which `point` + `velocity` t is in the closed `box`: [enter, exit], or a miss.
///
/// A start inside or on the surface gives enter == 0; without motion, exit == +infinity. A touch gives enter == exit.
/// A box with a half extent of 0 has no inside.
/// An exit beyond the largest finite number is +infinity, and an entry beyond it is a miss.
///
/// Units: velocity is length per unit of time. Never fails. Non-finite input: a miss. Source: in the frame of the
/// box, the times between each pair of face planes (Kay, Kajiya, Ray Tracing Complex Scenes, 1986).
template <class Tier = Fast, class T>
[[nodiscard]] inline Span<T> moving_point_span_box(const Vec3<T>& point, const Vec3<T>& velocity,
                                                   const Box<T>& box) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_point_span_box, TierOfDecisions<Tier>, point, velocity, box);
}

namespace contracts {

/// First order. An axis has an error of 16 eps (7 in each product of the quaternion, at most two of them, and the
/// sums). So a coordinate in the box's frame has an error of 19 eps of the distance, which is at most 4 G, and the
/// quotient by the speed along the axis adds 1 eps. The speed has an error of 19 eps, the half extent in units of it 1
/// eps.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_span_box() {
  return Tier::template contract<T>({.backward = 128, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
