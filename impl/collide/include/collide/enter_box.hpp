/// A point that enters a box from outside, in the box's frame: shared by the queries about it.
#pragma once

#include <array>

#include <collide/number.hpp>

namespace collide::detail {

/// Where a moving point enters the box; axis -1: it does not.
template <class T>
struct BoxEntry {
  int axis = -1;  ///< of the face's outward normal
  T side{1};      ///< +1 or -1
  T time{};
  std::array<T, 3> at{};
};

/// The entry of the point at + step t, which starts outside, into { x : low <= x <= high }. `over(gap, i)` is
/// the time that the motion takes to cross `gap` along axis i.
///
/// Of the face planes in front of which the point starts, the one reached last is where it enters, if it
/// does. Source: Woo, Fast Ray-Box Intersection, in Graphics Gems, 1990.
template <class T, class Over>
BoxEntry<T> enter_box(const std::array<T, 3>& at, const std::array<T, 3>& step, const std::array<T, 3>& low,
                      const std::array<T, 3>& high, Over over) noexcept {
  BoxEntry<T> entry;
  for (int i = 0; i < 3; ++i) {
    if (at[i] >= low[i] && at[i] <= high[i]) continue;
    const bool below = at[i] < low[i];
    if (!(below ? step[i] > T(0) : step[i] < T(0))) return {};
    const T time = over((below ? low[i] : high[i]) - at[i], i);
    if (entry.axis < 0 || time > entry.time) entry = {i, below ? T(-1) : T(1), time, {}};
  }
  if (entry.axis < 0) return {};
  for (int i = 0; i < 3; ++i) {
    if (i == entry.axis) {
      entry.at[i] = entry.side > T(0) ? high[i] : low[i];
      continue;
    }
    // Only the far plane can have been crossed: the near one by rounding, where two are reached at once.
    const T x = at[i] + step[i] * entry.time;
    if (!(step[i] > T(0) ? x <= high[i] : x >= low[i])) return {};
    entry.at[i] = clamped(x, low[i], high[i]);
  }
  return entry;
}

}  // namespace collide::detail
