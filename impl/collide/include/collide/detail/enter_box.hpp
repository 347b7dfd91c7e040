/// The entry of a moving point into a box, in the frame of the box: used by the queries about points, rays and boxes.
#pragma once

#include <array>

#include <collide/detail/lanes.hpp>
#include <collide/detail/number.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// The entry of a moving point into a box; axis is -1 if it does not enter.
template <class T>
struct BoxEntry {
  int axis = -1;  ///< axis of the entered face's outward normal
  T side{1};      ///< sign of the outward normal: +1 or -1
  T time{};
  std::array<T, 3> at{};
};

/// The entry of the point at + step t, which starts outside, into { x : low <= x <= high }. `over(gap, i)` returns the
/// time in which the motion crosses `gap` along axis i.
///
/// Of the face planes that the start is in front of, the point enters through the one reached last, if it enters at
/// all. Source: Woo, Fast Ray-Box Intersection, in Graphics Gems, 1990.
template <class T, class Over>
inline BoxEntry<T> enter_box(const std::array<T, 3>& at, const std::array<T, 3>& step, const std::array<T, 3>& low,
                             const std::array<T, 3>& high, Over over) {
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
    // In real numbers only the far plane can be crossed by now. Rounding may leave x before the near plane if two
    // planes are reached at once; clamping corrects that.
    const T x = at[i] + step[i] * entry.time;
    if (!(step[i] > T(0) ? x <= high[i] : x >= low[i])) return {};
    entry.at[i] = clamped(x, low[i], high[i]);
  }
  return entry;
}

#if defined(COLLIDE_LANES)

/// The entry of a moving point into a box in lanes, for any start.
template <class T>
struct BoxEntryInLanes {
  bool enters;    ///< the point enters or starts inside
  bool inside;    ///< the point starts in the closed box
  Lanes<T> time;  ///< the same in every lane; 0 for a start inside
  Lanes<T> at;
  Lanes<T> axis;   ///< mask of the entered faces: several if they are reached at once
  Lanes<T> below;  ///< mask of the coordinates in which the start is below the box
};

/// Branchless: computes every axis, then selects. Infinite and NaN inputs do not enter.
template <class T, class Over>
inline BoxEntryInLanes<T> enter_box(const Lanes<T>& at, const Lanes<T>& step, const Lanes<T>& low, const Lanes<T>& high,
                                    Over over) {
  using L = Lanes<T>;
  const L zero = L::splat(T(0)), most = L::splat(std::numeric_limits<T>::max());
  const L within = (low <= at) & (at <= high), below = at < low;
  const L face = select(below, low, high), gap = face - at;
  const L times = and_not(over(gap), within);
  const L time = largest_of_three(times);
  const L x = at + step * time;
  const L axis = and_not(times == time, within);
  const L ends_within = select(zero < step, x <= high, low <= x) | axis;
  const L wrong_way = and_not((gap ^ step) | (step == zero), within);  // in the sign bits
  const bool enters = all_three(and_not(ends_within & are_finite(at, step, low, high) & (time <= most), wrong_way));
  return {enters, all_three(within), time, select(axis, face, smaller(larger(x, low), high)), axis, below};
}

#endif

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
