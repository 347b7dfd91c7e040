/// The times at which a moving point is in a slab, in a ball or in several such sets: used by the queries about spans.
/// Each of these sets is convex, so that the times are an interval, and intersections are convex too.
#pragma once

#include <limits>

#include <collide/answers.hpp>
#include <collide/detail/contact.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// All times t >= 0.
template <class T>
Span<T> all_times() {
  return {T(0), std::numeric_limits<T>::infinity(), true};
}

/// Keeps the times at which `at` + `step` t lies in [low, high]; the span may become one whose end precedes its start.
template <class T>
void keep_between(Span<T>& span, const T& at, const T& step, const T& low, const T& high) {
  const bool up = step > T(0);
  if (up || step < T(0)) {
    span.enter = larger(span.enter, T(((up ? low : high) - at) / step));
    span.exit = smaller(span.exit, T(((up ? high : low) - at) / step));
  } else {
    span.decision = span.decision && low <= at && at <= high;
  }
}

/// Keeps the times at which `at` + `step` t lies in [-half, half].
///
/// The error of the middle time is that of `at`, and the rest has an error of 1 eps as if `half` had it: a tiny half
/// extent keeps its digits beside a large distance.
template <class T>
void keep_within(Span<T>& span, const T& at, const T& step, const T& half) {
  using detail::abs;
  if (step > T(0) || step < T(0)) {
    const T middle = -at / step, rest = half / abs(step);
    bool is_finite = true;
    if constexpr (MachineNumber<T>) is_finite = abs(middle) + rest <= std::numeric_limits<T>::max();
    if (is_finite) {
      span.enter = larger(span.enter, T(middle - rest));
      span.exit = smaller(span.exit, T(middle + rest));
      return;
    }
  }
  keep_between(span, at, step, T(-half), half);
}

/// Keeps the times at which a moving point is in a ball about the origin. Also works in two dimensions, with all
/// vectors in one plane.
template <class Tier, class T>
void keep_in_ball(Span<T>& span, const Vec3<T>& from, const Vec3<T>& velocity, const T& radius) {
  using detail::sqrt;
  const bool inside = Tier::beyond_radius(from, radius) <= T(0);
  const T speed2 = Tier::dot(velocity, velocity);
  if (!(speed2 > T(0))) {
    span.decision = span.decision && inside;
    return;
  }
  if (inside) {
    span.exit = smaller(span.exit, time_out_of_ball<Tier>(from, velocity, speed2, radius));
    return;
  }
  const T closing = -Tier::dot(from, velocity);
  if (!(closing > T(0))) return void(span.decision = false);
  const auto [nearest, chord2] = closest_approach<Tier>(from, velocity, closing, speed2, radius);
  if (!(chord2 >= T(0))) return void(span.decision = false);
  const T half = sqrt(chord2) / sqrt(speed2);
  span.enter = larger(span.enter, T(nearest - half));
  span.exit = smaller(span.exit, T(nearest + half));
}

/// The span, or a miss if it has no time or starts beyond the largest finite number.
template <class T>
Span<T> checked(const Span<T>& span) {
  if (!span.decision || !(span.enter <= span.exit)) return Span<T>::miss();
  return span.enter <= std::numeric_limits<T>::max() ? span : Span<T>::miss();
}

/// The times of `first` and of `second`, and those between them.
template <class T>
Span<T> joined(const Span<T>& first, const Span<T>& second) {
  if (!first.decision) return second;
  if (!second.decision) return first;
  return {smaller(first.enter, second.enter), larger(first.exit, second.exit), true};
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
