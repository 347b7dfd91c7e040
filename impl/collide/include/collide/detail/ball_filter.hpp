/// Filter of Certified for the first contact of a moving point and a ball that does not move.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/contact.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// A point and a ball in the wider type, for `ball_impact` and `impact_at_start`. The contact is the place of the
/// moving point or, with `inner` not negative, the point of a ball of this radius around the same center in the
/// direction of the normal.
template <class T>
struct PointAndBall {
  Vec3<T> start, velocity, center;
  Wider<T> radius;  ///< with an error of 1 u of itself
  T inner;
};

/// The impact where |w + velocity t| is the radius r, with the vector w from the center to the start; or nullopt.
/// `approach` is that of the point, which certainly reaches the ball from outside, or certainly starts inside and
/// leaves it.
///
/// Errors are in units of u, unless told otherwise. Let f be the larger of |w| and r. The point moves by at most f if
/// it comes from outside, else by 2 f. A step of Newton's method improves a time in double. At that time, the vector
/// from the center has an error of |w| + way + r, at most 4 f, so its square minus r^2 has one of 8 r f + 6 r^2, at
/// most 2^4 r f. The derivative is twice the chord, whose square has the error of the approach, 2^6 v of its terms (v =
/// 2^-53). That error counts for the step alone, and so does the change of the derivative within the step. The way has
/// an error of (time error + 1) of itself, and the normal one of ((time error + 1) way + |w| + r) / r and 4 more.
///
/// The coordinates are computed one after the other: registers of the wider type are few.
template <bool leaves, class T>
std::optional<Impact<T>> ball_impact(const PointAndBall<T>& at, const BallApproach& approach) {
  using W = Wider<T>;
  using In = InW<T, W>;
  using limits = std::numeric_limits<T>;
  const double chord = detail::sqrt(approach.chord2), per_chord = 1 / chord, closing = approach.closing;
  double estimate = approach.outside / (closing + chord);
  if constexpr (leaves)
    estimate = closing > 0 ? (closing + chord) / approach.speed2 : approach.outside / (closing - chord);
  const std::array<T, 3> from = components(at.start), to = components(at.center), step = components(at.velocity);
  W apart2 = W(0);
  for (std::size_t k = 0; k < 3; ++k) {
    const W apart = (W(from[k]) - W(to[k])) + W(step[k]) * W(estimate);
    apart2 = apart2 + apart * apart;
  }
  const double change = In::number(apart2 - at.radius * at.radius) * ((leaves ? -0.5 : 0.5) * per_chord);
  const W time = W(estimate) + W(change), per_radius = W(1) / at.radius;
  std::array<T, 3> normal, location;
  for (std::size_t k = 0; k < 3; ++k) {
    const W way = W(step[k]) * time, outward = ((W(from[k]) - W(to[k])) + way) * per_radius;
    normal[k] = T(outward);
    location[k] = T(at.inner >= T(0) ? W(to[k]) + outward * W(at.inner) : W(from[k]) + way);
  }
  const Impact<T> impact{T(time), {location[0], location[1], location[2]}, {normal[0], normal[1], normal[2]}};

  constexpr double farthest = leaves ? 2 : 1;
  const double r = In::number(at.radius), far = larger(detail::sqrt(approach.distance2), r);
  const double of_slope = 0x1p-47 * approach.of_chord2 * per_chord + 2 * approach.speed2 * detail::abs(change);
  const double of_time = (8 * r * far + detail::abs(change) * of_slope * (1 / In::u)) * (per_chord / estimate) + 2;
  const double of_normal = ((of_time + 1) * farthest + 2) * far / r + 4;
  const double of_place = at.inner >= T(0) ? (of_normal + 2) * double(at.inner) : (of_time + 2) * farthest * far;
  const T size = largest_magnitude(impact.location);
  if (of_time <= In::enough && of_normal <= In::enough / 2 && impact.time >= limits::min() &&
      impact.time <= limits::max() / 2 && size <= limits::max() && of_place <= In::enough * double(size))
    return impact;
  return std::nullopt;
}

/// The impact of a point that certainly starts inside the ball, at the start; or nullopt. The normal has an error of
/// 6 u.
template <class T>
std::optional<Impact<T>> impact_at_start(const PointAndBall<T>& at) {
  using W = Wider<T>;
  using In = InW<T, W>;
  const std::array<T, 3> from = components(at.start), to = components(at.center);
  const auto outward = [&](std::size_t k) { return W(from[k]) - W(to[k]); };
  const W inverse = W(1) / detail::sqrt(outward(0) * outward(0) + outward(1) * outward(1) + outward(2) * outward(2));
  std::array<T, 3> normal, location = from;
  for (std::size_t k = 0; k < 3; ++k) {
    const W n = outward(k) * inverse;
    normal[k] = T(n);
    if (at.inner >= T(0)) location[k] = T(W(to[k]) + n * W(at.inner));
  }
  const Impact<T> impact{T(0), {location[0], location[1], location[2]}, {normal[0], normal[1], normal[2]}};
  const double of_place = at.inner >= T(0) ? 8 * double(at.inner) : 0;
  if (of_place <= In::enough * double(largest_magnitude(impact.location))) return impact;
  return std::nullopt;
}

/// Filter: the certain answer for a moving point and a sphere, or nullopt.
template <class T>
std::optional<Impact<T>> filtered_impact(const Vec3<T>& point, const Vec3<T>& velocity, const Sphere<T>& sphere,
                                         bool solid) {
  const BallApproach approach =
      certain_approach(in_double(point) - in_double(sphere.center), in_double(velocity), double(sphere.radius));
  if (approach.misses) return Impact<T>::miss();
  if constexpr (has_wider<T>) {
    const PointAndBall<T> at{point, velocity, sphere.center, sphere.radius, T(-1)};
    if (approach.inside && solid) return impact_at_start(at);
    if (approach.reaches) return ball_impact<false>(at, approach);
    if (approach.inside) return ball_impact<true>(at, approach);
  }
  return std::nullopt;
}

/// Filter: the certain answer for a moving sphere and another one, or nullopt.
template <class T>
std::optional<Impact<T>> filtered_impact(const Sphere<T>& sphere, const Vec3<T>& velocity, const Sphere<T>& fixed) {
  const BallApproach approach = certain_approach(in_double(sphere.center) - in_double(fixed.center),
                                                 in_double(velocity), double(sphere.radius) + double(fixed.radius));
  if (approach.misses) return Impact<T>::miss();
  if constexpr (has_wider<T>) {
    const Wider<T> reach = Wider<T>(sphere.radius) + Wider<T>(fixed.radius);
    const PointAndBall<T> at{sphere.center, velocity, fixed.center, reach, fixed.radius};
    if (approach.reaches) return ball_impact<false>(at, approach);
    if (approach.inside) return sphere.radius > T(0) ? impact_at_start(at) : Impact<T>::miss();
  }
  return std::nullopt;
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
