/// A ray or a moving point, and a box, in the box's frame. Shared by the oracles of queries about them.
#pragma once

#include "oracles/algorithms/times.hpp"

namespace nearmiss::oracle {

/// The points at + step t, t >= 0, and the box { x : low <= x <= high }.
template <class N>
struct RayAndBox {
  Vector<N> at, step, low, high;
};

template <class N>
bool may_be_between(const N& low, const N& x, const N& high) {
  return may_be_at_most(low, x) && may_be_at_most(x, high);
}

/// Whether the ray may start in the closed box.
template <class N>
bool may_start_in(const RayAndBox<N>& r) {
  bool may = true;
  for (int i = 0; i < 3; ++i) may = may && may_be_between(r.low[i], r.at[i], r.high[i]);
  return may;
}

/// Whether the projection of the ray's start along axis k certainly lies in that of the box.
template <class N>
bool surely_starts_in_seen_along(const RayAndBox<N>& r, int k) {
  bool surely = true;
  for (const int i : {(k + 1) % 3, (k + 2) % 3}) {
    surely = surely && !may_be_less(r.at[i], r.low[i]) && !may_be_less(r.high[i], r.at[i]);
  }
  return surely;
}

/// Whether the ray may miss the box. Two convex sets are disjoint if an axis separates them: one of the box's axes, or
/// the cross product of such an axis with the ray's direction. This product is zero if the ray is parallel to the axis.
/// It never separates sets whose projections along the axis meet.
template <class N>
bool may_miss(const RayAndBox<N>& r) {
  for (int i = 0; i < 3; ++i) {
    if (may_be_less(r.high[i], r.at[i]) && may_be_at_least_zero(r.step[i])) return true;
    if (may_be_less(r.at[i], r.low[i]) && may_be_at_most_zero(r.step[i])) return true;
  }
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    bool may_all_lie_left = true, may_all_lie_right = true;
    for (const N& x : {r.low[i], r.high[i]}) {
      for (const N& y : {r.low[j], r.high[j]}) {
        const N left = r.step[i] * (y - r.at[j]) - r.step[j] * (x - r.at[i]);
        may_all_lie_left = may_all_lie_left && may_be_positive(left);
        may_all_lie_right = may_all_lie_right && may_be_negative(left);
      }
    }
    if ((may_all_lie_left || may_all_lie_right) && !surely_starts_in_seen_along(r, k)) return true;
  }
  return false;
}

/// Calls f(time, place) for each face through which a ray that starts outside may enter: the ray starts in front of the
/// face's plane and crosses the plane in the box. `place` is in the box's frame.
template <class N, class F>
void for_each_entry(const RayAndBox<N>& r, F&& f) {
  for (int i = 0; i < 3; ++i) {
    for (const int side : {-1, 1}) {
      const N& plane = side > 0 ? r.high[i] : r.low[i];
      const N gap = side > 0 ? N(r.at[i] - plane) : N(plane - r.at[i]);
      const N speed = side > 0 ? N(-r.step[i]) : r.step[i];
      if (!may_be_positive(gap) || !may_be_positive(speed)) continue;
      N time = time_across(gap, speed);
      Vector<N> place;
      if (!narrow_to_range(time, r.at, r.step, r.low, r.high)) continue;
      if (!place_in_range(time, r.at, r.step, r.low, r.high, place)) continue;
      place[i] = plane;
      bool may_be_in = true;
      for (int j = 0; j < 3; ++j) may_be_in = may_be_in && (j == i || may_be_between(r.low[j], place[j], r.high[j]));
      if (may_be_in) f(time, place);
    }
  }
}

/// Calls f(axis, side) for each face on which a point of the box may lie.
template <class N, class F>
void for_each_face_at(const RayAndBox<N>& r, const Vector<N>& place, F&& f) {
  for (int i = 0; i < 3; ++i) {
    if (may_be_at_most(r.high[i], place[i])) f(i, 1);
    if (may_be_at_most(place[i], r.low[i])) f(i, -1);
  }
}

}  // namespace nearmiss::oracle
