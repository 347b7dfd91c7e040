/// Bounds on the time of first contact. Shared by the oracles of queries with motions.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

/// A range of times, enclosed by doubles. Used for culling only.
struct Window {
  double from = 0, to = std::numeric_limits<double>::infinity();

  bool empty() const { return !(from <= to); }
  void clip(const Window& w) {
    from = std::max(from, w.from);
    to = std::min(to, w.to);
  }
  /// Encloses both ranges.
  void include(const Window& w) {
    if (w.empty()) return;
    *this = empty() ? w : Window{std::min(from, w.from), std::max(to, w.to)};
  }
};

/// Encloses the times t >= 0 at which a + b t <= 0 for some a and b of the enclosures. Because t is not negative, only
/// their lower bounds matter.
template <class N>
Window times_not_positive(const N& a, const N& b) {
  const double a_low = bounds(a).low, b_low = bounds(b).low;
  if (a_low <= 0 && b_low <= 0) return {};
  if (a_low > 0 && b_low >= 0) return {1, 0};
  const double crossing = -a_low / b_low;
  if (a_low <= 0) return {0, std::nextafter(crossing, Window{}.to)};
  return {std::max(0.0, std::nextafter(crossing, 0.0)), Window{}.to};
}

/// The times at which a coordinate is on `side` of [-half, half].
template <class N>
Window times_on_side(const N& start, const N& step, const N& half, int side) {
  if (side > 0) return times_not_positive(N(half - start), N(-step));
  if (side < 0) return times_not_positive(N(half + start), step);
  Window w = times_not_positive(N(start - half), step);
  w.clip(times_not_positive(N(-start - half), N(-step)));
  return w;
}

/// Encloses the times at which a point at w with velocity u is within sqrt(`reach2`) of the origin; `moment2` is |w x
/// u|^2. For enclosures only.
inline Window times_within(const Vector<Interval>& w, const Vector<Interval>& u, const Interval& reach2,
                           const Interval& moment2) {
  const Interval closing = -dot(w, u), speed2 = norm2(u), chord2 = speed2 * reach2 - moment2;
  const Interval outside = norm2(w) - reach2;
  constexpr Window never{1, 0};
  if (!may_be_at_least_zero(chord2)) return never;
  const Interval half = root(chord2);
  Window times;
  if (!may_be_at_most_zero(outside)) {
    if (!may_be_positive(closing)) return never;
    const double largest = (assume_at_least_zero(closing) + half).sup();
    if (std::isfinite(largest)) times.from = (outside / Interval(largest)).inf();
  }
  if (!may_be_zero(speed2)) times.to = ((closing + half) / speed2).sup();
  return times;
}

/// The quotient, intersected with the window, so that it is bounded even if the divisor may be zero. Empty if the
/// intersection is empty.
inline std::optional<Interval> time_within(const Window& w, const Interval& numerator, const Interval& divisor) {
  Interval time(w.from, w.to);
  if (!may_be_zero(divisor) && !narrow(time, numerator / divisor)) return std::nullopt;
  return time;
}
inline std::optional<Exact> time_within(const Window&, const Exact& numerator, const Exact& divisor) {
  return numerator / divisor;
}

}  // namespace nearmiss::oracle
