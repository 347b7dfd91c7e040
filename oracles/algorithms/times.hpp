/// Times of linear motions, known also where a speed may be zero. Shared by the oracles of moving points.
#pragma once

#include <limits>

#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

/// Any time from 0 on.
template <class N>
N any_time() {
  if constexpr (is_enclosure<N>) {
    return N(0.0, std::numeric_limits<double>::infinity());
  } else {
    return N(0);
  }
}

/// The time in which `gap`, not negative, is crossed at `speed`, which is positive in the branch at hand.
template <class N>
N time_across(const N& gap, const N& speed) {
  if (may_be_zero(speed)) return any_time<N>();
  return assume_at_least_zero(gap) / assume_at_least_zero(speed);
}

/// Narrows `time`, at which the point at + step t lies between the points low and high, to what that leaves
/// of it; false where it leaves nothing. Exact times stay as they are.
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

/// The place of the moving point at that time, known to lie between low and high; false where it cannot.
/// Exact places stay as they are.
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
