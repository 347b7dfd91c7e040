/// Times of linear motions, bounded even if a speed may be zero. Shared by the oracles of moving points.
#pragma once

#include <limits>

#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

/// Any time t >= 0.
template <class N>
N any_time() {
  if constexpr (is_enclosure<N>) {
    return N(0.0, std::numeric_limits<double>::infinity());
  } else {
    return N(0);
  }
}

/// The end of a motion that never ends: it stands for +infinity, and is beyond every number of a scalar.
template <class N>
N unending() {
  if constexpr (is_enclosure<N>) {
    return of_bound(std::numeric_limits<double>::infinity());
  } else {
    return N(beyond_all_scalars());
  }
}

/// The time in which `gap` >= 0 is crossed at `speed`, which is positive in the current branch.
template <class N>
N time_across(const N& gap, const N& speed) {
  if (may_be_zero(speed)) return any_time<N>();
  return assume_at_least_zero(gap) / assume_at_least_zero(speed);
}

/// Narrows `time` to when the point at + step t lies between the points low and high; false if there is no such time.
/// Leaves exact times as they are.
template <class N>
bool narrow_to_range(N& time, const Vector<N>& at, const Vector<N>& step, const Vector<N>& low, const Vector<N>& high) {
  if constexpr (is_enclosure<N>) {
    for (int i = 0; i < 3; ++i) {
      if (may_be_zero(step[i])) continue;
      if (!narrow(time, N((join(low[i], high[i]) - at[i]) / step[i]))) return false;
    }
  }
  return true;
}

/// The place of the moving point at that time, intersected with the box from low to high; false if the intersection is
/// empty. Leaves exact places as they are.
template <class N>
bool place_in_range(const N& time, const Vector<N>& at, const Vector<N>& step, const Vector<N>& low,
                    const Vector<N>& high, Vector<N>& place) {
  for (int i = 0; i < 3; ++i) {
    if constexpr (is_enclosure<N>) {
      place[i] = join(low[i], high[i]);
      if (!(time.sup() < std::numeric_limits<double>::infinity())) continue;
      if (!narrow(place[i], N(at[i] + step[i] * time))) return false;
    } else {
      place[i] = at[i] + step[i] * time;
    }
  }
  return true;
}

}  // namespace nearmiss::oracle
