/// The times at which a moving point is in a convex set, of which slabs, balls and tubes are made. Shared by the
/// oracles of spans.
#pragma once

#include "oracles/algorithms/times.hpp"

namespace nearmiss::oracle {

/// What is known of the times t >= 0 at which a moving point is in a closed convex set. For exact numbers one of the
/// two flags is set.
template <class N>
struct Times {
  bool may_be_none = false, may_be_some = false;
  N enter{}, exit{};  ///< of those cases in which there are some

  static Times none() { return {.may_be_none = true}; }
  static Times some(const N& enter, const N& exit) { return {.may_be_some = true, .enter = enter, .exit = exit}; }
  static Times always() { return some(N(0), unending<N>()); }

  /// Either this or the other may be the case.
  void include(const Times& other) {
    may_be_none = may_be_none || other.may_be_none;
    if (!other.may_be_some) return;
    enter = may_be_some ? join(enter, other.enter) : other.enter;
    exit = may_be_some ? join(exit, other.exit) : other.exit;
    may_be_some = true;
  }
};

inline Interval later(const Interval& a, const Interval& b) {
  return {std::max(a.inf(), b.inf()), std::max(a.sup(), b.sup())};
}
inline Interval earlier(const Interval& a, const Interval& b) {
  return {std::min(a.inf(), b.inf()), std::min(a.sup(), b.sup())};
}
inline const Exact& later(const Exact& a, const Exact& b) { return may_be_less(a, b) ? b : a; }
inline const Exact& earlier(const Exact& a, const Exact& b) { return may_be_less(b, a) ? b : a; }

/// The times in both sets. Whether there are some depends on the entry of one and the exit of the other.
template <class N>
Times<N> both(const Times<N>& a, const Times<N>& b) {
  if (!a.may_be_some || !b.may_be_some) return Times<N>::none();
  if (!may_be_at_most(a.enter, b.exit) || !may_be_at_most(b.enter, a.exit)) return Times<N>::none();
  Times<N> times = Times<N>::some(later(a.enter, b.enter), earlier(a.exit, b.exit));
  times.may_be_none = a.may_be_none || b.may_be_none || may_be_less(b.exit, a.enter) || may_be_less(a.exit, b.enter);
  return times;
}

/// The times in either set or between them, for sets whose union is convex.
template <class N>
Times<N> either(const Times<N>& a, const Times<N>& b) {
  if (!a.may_be_some) return b;
  if (!b.may_be_some) return a;
  Times<N> times = Times<N>::some(earlier(a.enter, b.enter), later(a.exit, b.exit));
  if constexpr (is_enclosure<N>) {  // a set that may be missed bounds the times on one side only
    if (a.may_be_none) times.enter = join(times.enter, b.enter), times.exit = join(times.exit, b.exit);
    if (b.may_be_none) times.enter = join(times.enter, a.enter), times.exit = join(times.exit, a.exit);
  }
  times.may_be_none = a.may_be_none && b.may_be_none;
  return times;
}

/// A gap that is not negative, crossed at a speed that is not negative; unbounded if the speed may be zero.
inline Interval crossing(const Interval& gap, const Interval& speed) {
  if (!may_be_zero(speed)) return gap / speed;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!(speed.sup() > 0 && speed.sup() < infinity)) return {0, infinity};
  return {(of_bound(gap.inf()) / of_bound(speed.sup())).inf(), infinity};
}
inline Exact crossing(const Exact& gap, const Exact& speed) { return gap / speed; }

/// The times at which at + step t lies in [low, high], for a step that is not zero.
template <class N>
Times<N> times_between_moving_up(const N& at, const N& step, const N& low, const N& high) {
  const N to_low = low - at, to_high = high - at, speed = assume_at_least_zero(step);
  if (!may_be_at_least_zero(to_high)) return Times<N>::none();
  const N enter = may_be_positive(to_low) ? crossing(assume_at_least_zero(to_low), speed) : N(0);
  Times<N> times = Times<N>::some(enter, crossing(assume_at_least_zero(to_high), speed));
  times.may_be_none = may_be_negative(to_high);
  return times;
}

/// The times at which at + step t lies in [low, high], where low <= high.
template <class N>
Times<N> times_between(const N& at, const N& step, const N& low, const N& high) {
  Times<N> times;
  if (may_be_positive(step)) times.include(times_between_moving_up(at, step, low, high));
  if (may_be_negative(step)) times.include(times_between_moving_up(N(-at), N(-step), N(-high), N(-low)));
  if (may_be_zero(step)) {
    if (may_be_less(at, low) || may_be_less(high, at)) times.include(Times<N>::none());
    if (may_be_at_most(low, at) && may_be_at_most(at, high)) times.include(Times<N>::always());
  }
  return times;
}

/// The times at which a t^2 - 2 closing t + outside <= 0, where a >= 0, `discriminant` is closing^2 - a outside, and a
/// = 0 implies closing = 0: those at which a point is in a ball or in an infinite tube.
template <class N>
Times<N> times_within_roots(const N& a, const N& closing, const N& outside, const N& discriminant) {
  Times<N> times;
  if (may_be_zero(a)) {
    if (may_be_positive(outside)) times.include(Times<N>::none());
    if (may_be_at_most_zero(outside)) times.include(Times<N>::always());
  }
  if (!may_be_positive(a)) return times;
  const N speed2 = assume_at_least_zero(a);
  if (may_be_at_most_zero(outside)) {
    const N half = root(discriminant);
    N exit = any_time<N>();
    if (!may_be_zero(speed2)) exit = assume_at_least_zero(N((closing + half) / speed2));
    if constexpr (is_enclosure<N>) {
      exit = meet(exit, crossing(assume_at_least_zero(-outside), assume_at_least_zero(half - closing)));
    }
    times.include(Times<N>::some(N(0), exit));
  }
  if (!may_be_positive(outside)) return times;
  if (may_be_at_most_zero(closing) || may_be_negative(discriminant)) times.include(Times<N>::none());
  if (!may_be_positive(closing) || !may_be_at_least_zero(discriminant)) return times;
  const N half = root(discriminant), far = assume_at_least_zero(closing) + half;
  N enter = crossing(assume_at_least_zero(outside), far);
  if (!may_be_zero(speed2)) enter = meet(enter, assume_at_least_zero(N((closing - half) / speed2)));
  times.include(Times<N>::some(enter, crossing(far, speed2)));
  return times;
}

/// The times in a ball; `from` is the vector from its center to the point.
template <class N>
Times<N> times_in_ball(const Vector<N>& from, const Vector<N>& step, const N& radius) {
  const N speed2 = norm2(step);
  return times_within_roots(speed2, N(-dot(from, step)), N(norm2(from) - square(radius)),
                            N(speed2 * square(radius) - norm2(cross(from, step))));
}

/// The times in { x : low <= x <= high }.
template <class N>
Times<N> times_in_box(const Vector<N>& at, const Vector<N>& step, const Vector<N>& low, const Vector<N>& high) {
  Times<N> times = Times<N>::always();
  for (int i = 0; i < 3; ++i) times = both(times, times_between(at[i], step[i], low[i], high[i]));
  return times;
}

/// Reports all right answers.
template <class N, class Out>
void report_span(Times<N> times, Out& out) {
  if (times.may_be_none) out.no();
  if (!times.may_be_some) return;
  if constexpr (is_enclosure<N>) {  // the entry is not after the exit
    times.enter = earlier(times.enter, of_bound(times.exit.sup()));
    times.exit = later(times.exit, of_bound(times.enter.inf()));
  }
  out.yes({times.enter, times.exit, true});
}

}  // namespace nearmiss::oracle
