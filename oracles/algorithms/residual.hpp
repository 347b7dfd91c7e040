/// Enclosures by a Newton step about a fixed point. A time or a place that solves an equation is a nearby fixed one
/// minus the residual there over a slope. The residual is small and has every input once, so the enclosure's width is
/// that of the answer, not that of the intermediate numbers. Plain doubles choose the fixed point; any choice is
/// correct. For enclosures only. Shared by the oracles of queries with motions.
#pragma once

#include <cmath>

#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

/// A number of few bits near the middle. Enclosures that differ by little have the same one.
inline double near_middle(const Interval& x) { return double(float(0.5 * x.inf() + 0.5 * x.sup())); }

/// Far from overflow, also as a float, so that no operation on a few such numbers is invalid.
inline bool is_moderate(const Interval& x) { return x.inf() > -0x1p+100 && x.sup() < 0x1p+100; }
inline bool is_moderate(const Vector<Interval>& x) {
  return is_moderate(x[0]) && is_moderate(x[1]) && is_moderate(x[2]);
}

/// Intersects every component; false if the intersection is empty, so that the branch is impossible.
inline bool narrow(Vector<Interval>& x, const Vector<Interval>& to) {
  return narrow(x[0], to[0]) && narrow(x[1], to[1]) && narrow(x[2], to[2]);
}

/// Weights of few bits that combine the corners to approximately x, as far as x lies in their plane.
inline std::array<double, 2> near_weights(const std::array<Vector<Interval>, 3>& corner,
                                          const std::array<double, 3>& x) {
  double aa = 0, ab = 0, bb = 0, aw = 0, bw = 0;
  for (int k = 0; k < 3; ++k) {
    const double c = near_middle(corner[0][k]);
    const double a = near_middle(corner[1][k]) - c, b = near_middle(corner[2][k]) - c, w = x[k] - c;
    aa += a * a, ab += a * b, bb += b * b, aw += a * w, bw += b * w;
  }
  const double det = aa * bb - ab * ab;
  if (!(det > 0)) return {0, 0};
  return {double(float((aw * bb - bw * ab) / det)), double(float((bw * aa - aw * ab) / det))};
}

/// The combination of the corners with these weights; the weight of the first corner completes their sum to 1.
inline Vector<Interval> combined(const std::array<Vector<Interval>, 3>& corner, const std::array<double, 2>& weight) {
  const Interval s(weight[0]), u(weight[1]), rest = Interval(1) - s - u;
  return plus(plus(times(corner[0], rest), times(corner[1], s)), times(corner[2], u));
}

/// Narrows the time and the place at which p + v t crosses the plane of the corners, whose normal is n; n . v is not
/// zero. False if the intersection is empty.
inline bool narrow_to_crossing(const Vector<Interval>& p, const Vector<Interval>& v,
                               const std::array<Vector<Interval>, 3>& corner, const Vector<Interval>& n, Interval& time,
                               Vector<Interval>& place) {
  if (!is_moderate(p) || !is_moderate(v) || !is_moderate(time)) return true;
  for (const Vector<Interval>& c : corner) {
    if (!is_moderate(c)) return true;
  }
  const Interval inverse = Interval(1) / dot(n, v);
  if (!is_moderate(inverse)) return true;
  const Vector<Interval> slope = times(n, inverse);
  const double t0 = near_middle(time);
  std::array<double, 3> x0;
  for (int k = 0; k < 3; ++k) x0[k] = near_middle(p[k]) + near_middle(v[k]) * t0;
  const std::array<double, 2> weight = near_weights(corner, x0);
  if (!(std::abs(weight[0]) < 0x1p20 && std::abs(weight[1]) < 0x1p20)) return true;
  // Both of these are about zero. Any combination of the corners lies in the plane.
  const Vector<Interval> middle{Interval(x0[0]), Interval(x0[1]), Interval(x0[2])};
  const Vector<Interval> ahead = minus(plus(p, times(v, Interval(t0))), middle);
  const Vector<Interval> in_plane = minus(combined(corner, weight), middle);
  if (!narrow(time, Interval(Interval(t0) - dot(slope, minus(ahead, in_plane))))) return false;
  Vector<Interval> tighter = middle;
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k < 3; ++k) {
      const Interval across = v[j] * slope[k];
      tighter[j] = tighter[j] + (Interval(j == k ? 1 : 0) - across) * ahead[k] + across * in_plane[k];
    }
  }
  return narrow(place, tighter);
}

/// Narrows the time at which |`from` + `step` t| equals `reach`. If `along`, of squared length `length2`, is given,
/// only the component perpendicular to it counts. `from` plus `step` times about the middle of `time` should be short
/// along `along`. False if the intersection is empty.
inline bool narrow_to_reach(const Vector<Interval>& from, const Vector<Interval>& step, const Vector<Interval>* along,
                            const Interval& length2, const Interval& reach, Interval& time) {
  if (!is_moderate(from) || !is_moderate(step) || !is_moderate(time)) return true;
  const double t0 = near_middle(time);
  const Vector<Interval> at_t0 = plus(from, times(step, Interval(t0)));
  const Vector<Interval> at_any = plus(from, times(step, join(time, Interval(t0))));
  Interval beyond = norm2(at_t0) - square(reach), slope = dot(step, at_any);
  if (along != nullptr) {
    beyond = beyond - square(dot(at_t0, *along)) / length2;
    slope = slope - dot(step, *along) * dot(at_any, *along) / length2;
  }
  if (may_be_zero(slope) || !is_moderate(beyond)) return true;
  return narrow(time, Interval(Interval(t0) - beyond / (Interval(2) * slope)));
}

}  // namespace nearmiss::oracle
