/// The times at which a moving point is in a sphere.
#pragma once

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/moving_point_span_sphere.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

namespace collide {

/// The times t >= 0 at which `point` + `velocity` t is in the closed `sphere`: [enter, exit], or a miss.
///
/// A start inside or on the surface gives enter == 0; without motion, exit == +infinity. A touch gives enter == exit.
/// A sphere of radius 0 is a point.
/// An exit beyond the largest finite number is +infinity, and an entry beyond it is a miss.
///
/// Units: velocity is length per unit of time. Never fails. Non-finite input: a miss. Source: the roots of
/// |point + velocity t - center|^2 == radius^2, with the discriminant computed from the distance between the center and
/// the line of motion (Haines, Guenther, Akenine-Moeller, Precision Improvements for Ray/Sphere Intersection, 2019).
template <class Tier = Fast, class T>
[[nodiscard]] inline Span<T> moving_point_span_sphere(const Vec3<T>& point, const Vec3<T>& velocity,
                                                      const Sphere<T>& sphere) noexcept(Tier::never_throws) {
  COLLIDE_ANSWER(moving_point_span_sphere, TierOfDecisions<Tier>, point, velocity, sphere);
}

namespace contracts {

/// First order. The vector from center to point has an error of 2 eps of G per axis. The closest approach has an error
/// of 9 eps of that distance (at most 4 G), its square and the radius 4 eps more. Half the chord has an error of 3 eps
/// of itself, as if the speed had it; then the time of the closest approach takes as much of the distance.
template <class Tier = Fast, class T = double>
constexpr Contract moving_point_span_sphere() {
  return Tier::template contract<T>({.backward = 64, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide
