/// The times at which a moving point is in a capsule.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_span_capsule.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The times t >= 0 at which `point` + `velocity` t is in the closed `capsule`: [enter, exit], or a miss.
///
/// A start inside or on the surface gives enter == 0; without motion, exit == +infinity. A touch gives enter == exit.
/// A capsule of radius 0 is a segment, and one with p0 == p1 is a ball.
/// An exit beyond the largest finite number is +infinity, and an entry beyond it is a miss.
///
/// Units: velocity is length per unit of time. Never fails. Non-finite input: a miss. Source: a capsule is the union of
/// the balls at its ends and the tube between them. It is convex, so the first of the entries and the last of the exits
/// are its own.
template <class Tier = Fast, class T>
[[nodiscard]] inline Span<T> moving_point_span_capsule(const Vec3<T>& point, const Vec3<T>& velocity,
                                                       const Capsule<T>& capsule) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_point_span_capsule, TierOfDecisions<Tier>, point, velocity, capsule);
}

namespace contracts {

/// First order. The axis has an error of 4 eps. The coordinate along it has an error of 8 eps of a distance of at most
/// 4 G, the rest perpendicular to it 10 eps. The closest approach has an error of 9 eps of the same distance, its
/// square and the radius 4 eps more; half the chord has 3 eps of itself, as if the speed had it.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_span_capsule() {
  return Tier::template contract<T>({.backward = 128, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
