/// The times at which a moving point is in an axis-aligned box.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_span_aabox.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The times t >= 0 at which `point` + `velocity` t is in the closed `aabox`: [enter, exit], or a miss.
///
/// A start inside or on the surface gives enter == 0; without motion, exit == +infinity. A touch gives enter == exit.
/// A box with min == max in a coordinate is a rectangle, a segment or a point.
/// An exit beyond the largest finite number is +infinity, and an entry beyond it is a miss.
///
/// Units: velocity is length per unit of time. Never fails. Non-finite input: a miss. Source: the times between
/// each pair of face planes (Kay, Kajiya, Ray Tracing Complex Scenes, 1986).
template <class Tier = Fast, class T>
[[nodiscard]] inline Span<T> moving_point_span_aabox(const Vec3<T>& point, const Vec3<T>& velocity,
                                                     const AABox<T>& aabox) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_point_span_aabox, TierOfDecisions<Tier>, point, velocity, aabox);
}

namespace contracts {

/// First order. A gap between the point and a face has an error of 1 eps of 2 G, and the quotient adds as much. Each
/// time has a face of its own, and rounding keeps the order of two faces: moving each by 2 * 2 eps of G accounts for
/// all.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_span_aabox() {
  return Tier::template contract<T>({.backward = 4, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
