/// Bodies in long double and bounds of their distances: certificates that share no code with the oracle. Any direction
/// in which two bodies are apart bounds their distance from below. Any pair of points, one of each body, bounds it from
/// above. The search for directions and points proves nothing and need not be right. For properties/judge/lies.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <limits>
#include <vector>

namespace nearmiss::bodies {

using Real = long double;
using Point = std::array<Real, 3>;
static_assert(LDBL_MANT_DIG >= 64 && LDBL_MAX_EXP >= 16384, "squares of doubles must neither overflow nor underflow");

inline constexpr Real infinite = std::numeric_limits<Real>::infinity();

inline Point plus(const Point& a, const Point& b, Real factor = 1) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
inline Point minus(const Point& a, const Point& b) { return plus(a, b, -1); }
inline Point scaled(const Point& a, Real factor) { return {a[0] * factor, a[1] * factor, a[2] * factor}; }
inline Real dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Real length(const Point& a) { return std::sqrt(dot(a, a)); }
inline Real clamp01(Real x) { return x > 0 ? std::min<Real>(x, 1) : 0; }  // NaN: 0

/// A number and a vector of an input, each with a bound on how far it may move. For a vector the bound is on the length
/// of the change.
struct Number {
  Real at, slack;
};
struct Vector {
  Point at;
  Real slack;
};

/// The convex hull of points, or a box, thickened by a radius. No point of the body moves by more than the slack.
struct Body {
  std::vector<Point> corners;  ///< one to three; none for a box
  Point center{}, half{};      ///< of a box
  std::array<Point, 3> axes{};
  Real radius = 0;
  Real slack = 0;

  bool is_box() const { return corners.empty(); }
  Point middle() const;
  /// The nearest point of the body without its radius, or one not far from the nearest: always a point of the body.
  Point nearest(const Point& x) const;
  /// The largest u . y over the points y of the body without its radius.
  Real reach(const Point& u) const;
  /// The depth inside the faces of a box; negative outside, -infinity for a body without an inside.
  Real depth(const Point& x) const;
  /// An upper bound of the distance of its points from its middle.
  Real size() const;
  Point local(const Point& x) const;
};

inline Body ball(const Vector& center, const Number& radius) {
  Body b;
  b.corners = {center.at};
  b.radius = radius.at, b.slack = center.slack + radius.slack;
  return b;
}
inline Body hull(const std::vector<Vector>& corners, const Number& radius = {0, 0}) {
  Body b;
  for (const Vector& c : corners) b.corners.push_back(c.at), b.slack = std::max(b.slack, c.slack);
  b.radius = radius.at, b.slack += radius.slack;
  return b;
}
inline Body upright_box(const Vector& low, const Vector& high) {
  Body b;
  b.center = scaled(plus(low.at, high.at), 0.5L), b.half = scaled(minus(high.at, low.at), 0.5L);
  for (int k = 0; k < 3; ++k) b.axes[k][k] = 1;
  b.slack = std::max(low.slack, high.slack);
  return b;
}

/// The axes of a box's rotation, and how far each may turn: a bound on the change of the unit vector.
struct Axes {
  std::array<Point, 3> at;
  Real slack;
};
/// For unit quaternions p and q, |R(p) - R(q)| <= 2 |p - q|; and |x / |x| - y / |y|| <= 2 |x - y| / |x|.
inline Axes axes_of(const std::array<Real, 4>& q, Real slack) {
  const auto [x, y, z, w] = q;
  const Real n = x * x + y * y + z * z + w * w;
  Axes a;
  a.at[0] = {(w * w + x * x - y * y - z * z) / n, 2 * (x * y + w * z) / n, 2 * (x * z - w * y) / n};
  a.at[1] = {2 * (x * y - w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z + w * x) / n};
  a.at[2] = {2 * (x * z + w * y) / n, 2 * (y * z - w * x) / n, (w * w - x * x - y * y + z * z) / n};
  a.slack = std::min<Real>(2, 4 * slack / std::sqrt(n));
  return a;
}
inline Body turned_box(const Vector& center, const Vector& half, const Axes& axes) {
  Body b;
  b.center = center.at, b.half = half.at, b.axes = axes.at;
  b.slack = center.slack + half.slack + length(half.at) * axes.slack;
  return b;
}

inline Point Body::middle() const {
  if (is_box()) return center;
  Point sum{};
  for (const Point& c : corners) sum = plus(sum, c, Real(1) / Real(corners.size()));
  return sum;
}
inline Point Body::local(const Point& x) const {
  const Point d = minus(x, center);
  return {dot(axes[0], d), dot(axes[1], d), dot(axes[2], d)};
}

inline Point nearest_of_segment(const Point& a, const Point& b, const Point& x) {
  const Point d = minus(b, a);
  return plus(a, d, clamp01(dot(minus(x, a), d) / dot(d, d)));
}
inline Point nearest_of_triangle(const std::vector<Point>& c, const Point& x) {
  const Point a = minus(c[1], c[0]), b = minus(c[2], c[0]), w = minus(x, c[0]);
  const Real aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), aw = dot(a, w), bw = dot(b, w), det = aa * bb - ab * ab;
  const Real s = (aw * bb - bw * ab) / det, t = (bw * aa - aw * ab) / det;
  Point best = nearest_of_segment(c[0], c[1], x);
  const auto consider = [&](const Point& y) {
    if (length(minus(y, x)) < length(minus(best, x))) best = y;
  };
  consider(nearest_of_segment(c[1], c[2], x));
  consider(nearest_of_segment(c[2], c[0], x));
  if (s >= 0 && t >= 0 && s + t <= 1) consider(plus(plus(c[0], a, s), b, t));
  return best;
}
inline Point Body::nearest(const Point& x) const {
  if (corners.size() == 1) return corners[0];
  if (corners.size() == 2) return nearest_of_segment(corners[0], corners[1], x);
  if (corners.size() == 3) return nearest_of_triangle(corners, x);
  const Point l = local(x);
  Point y = center;
  for (int k = 0; k < 3; ++k) y = plus(y, axes[k], std::clamp(l[k], -half[k], half[k]));
  return y;
}

inline Real Body::reach(const Point& u) const {
  if (is_box()) {
    Real sum = dot(u, center);
    for (int k = 0; k < 3; ++k) sum += half[k] * std::abs(dot(u, axes[k]));
    return sum;
  }
  Real most = -infinite;
  for (const Point& c : corners) most = std::max(most, dot(u, c));
  return most;
}

inline Real Body::depth(const Point& x) const {
  if (!is_box()) return -infinite;
  const Point l = local(x);
  Real least = infinite;
  for (int k = 0; k < 3; ++k) least = std::min(least, half[k] - std::abs(l[k]));
  return least;
}

inline Real Body::size() const {
  if (is_box()) return length(half);
  Real most = 0;
  for (const Point& c : corners) most = std::max(most, length(minus(c, middle())));
  return most;
}

/// The distance of two bodies without their slacks, from `low` to `high`; negative if their radii overlap.
struct Gap {
  Real low = -infinite, high = infinite;
  Point from{}, to{};  ///< points near to each other: of the first body, of the second body
};

/// The gap from a to b in direction u, without slacks.
inline Real gap_along(const Body& a, const Body& b, const Point& u) {
  const Real n = length(u);
  if (!(n > 0)) return -infinite;
  return (-b.reach(scaled(u, -1)) - a.reach(u)) / n - a.radius - b.radius;
}

/// By alternating projection.
inline Gap gap_of(const Body& a, const Body& b) {
  Gap g;
  Point x = a.nearest(b.middle());
  constexpr int most_steps = 60;
  for (int step = 0; step < most_steps; ++step) {
    const Point y = b.nearest(x);
    x = a.nearest(y);
    const Point u = minus(y, x);
    const Real apart = length(u) - a.radius - b.radius;
    if (apart < g.high) g.high = apart, g.from = x, g.to = y;
    g.low = std::max(g.low, gap_along(a, b, u));
    if (!(apart - g.low > 0x1p-20L * std::abs(apart))) break;
  }
  if (g.low > g.high) g.low = g.high;
  return g;
}

/// Whether the bodies are apart, or overlap, for every motion within the slacks.
inline bool surely_apart(const Body& a, const Body& b, const Gap& g) { return g.low > a.slack + b.slack; }

/// How far some point of a is inside the faces of b: a lower bound of how far a body must move to leave the other.
inline Real depth_within(const Body& a, const Body& b, const Gap& g) {
  Real most = -infinite;
  constexpr int steps = 16;
  for (int i = 0; i <= steps; ++i) {
    const Point toward = plus(g.to, minus(b.middle(), g.to), Real(i) / steps);
    most = std::max(most, b.depth(a.nearest(toward)));
  }
  return most;
}
inline Real least_depth(const Body& a, const Body& b, const Gap& g) {
  return std::max({-g.high, depth_within(a, b, g), depth_within(b, a, g)});
}
inline bool surely_overlap(const Body& a, const Body& b, const Gap& g) {
  return least_depth(a, b, g) > a.slack + b.slack;
}

/// A ball, or a point of radius 0, that moves past a fixed body.
struct Motion {
  Vector from, velocity;
  Number radius;

  Point at(Real time) const { return plus(from.at, velocity.at, time); }
  Body body_at(Real time) const { return ball({at(time), from.slack + time * velocity.slack}, radius); }
};

/// The signed distance and its error bound.
inline Number distance_at(const Motion& m, const Body& fixed, Real time) {
  const Point x = m.at(time);
  return {length(minus(x, fixed.nearest(x))) - m.radius.at - fixed.radius,
          m.from.slack + time * m.velocity.slack + m.radius.slack + fixed.slack};
}

/// About the time of least distance in [0, until]. The distance is convex, so the sign of its slope tells on which side
/// that time is.
inline Real time_of_least_distance(const Motion& m, const Body& fixed, Real until) {
  const Real speed = length(m.velocity.at);
  if (!(speed > 0)) return 0;
  Real low = 0, high = std::min(until, 2 * (length(minus(fixed.middle(), m.from.at)) + fixed.size()) / speed);
  constexpr int steps = 60;
  for (int i = 0; i < steps; ++i) {
    const Real t = 0.5L * (low + high);
    const Point x = m.at(t);
    (dot(m.velocity.at, minus(x, fixed.nearest(x))) < 0 ? low : high) = t;
  }
  return 0.5L * (low + high);
}

/// What is certain about a motion past a body, for every motion within the slacks.
struct Passage {
  bool surely_never = false;  ///< they never touch
  bool surely_meet = false;   ///< they overlap at some time
  Real not_before = 0;        ///< they touch at no earlier time
  Real by = infinite;         ///< they overlap at this time, if they certainly meet
  bool surely_start_apart = false, surely_start_overlapping = false;
};

/// A lower bound of the time of contact, from the gap along u at the start and the speed at which it may close.
inline Real not_before_along(const Motion& m, const Body& fixed, const Point& u) {
  const Real n = length(u);
  if (!(n > 0)) return 0;
  const Real gap = gap_along(fixed, m.body_at(0), u) - m.from.slack - m.radius.slack - fixed.slack;
  const Real closing = -dot(u, m.velocity.at) / n + m.velocity.slack;
  if (!(gap > 0)) return 0;
  return closing > 0 ? gap / closing : infinite;
}

inline Passage passage_of(const Motion& m, const Body& fixed, Real until = infinite) {
  Passage p;
  const Number start = distance_at(m, fixed, 0);
  p.surely_start_apart = surely_apart(m.body_at(0), fixed, gap_of(m.body_at(0), fixed));
  p.surely_start_overlapping = start.at < -start.slack;
  const Real least = time_of_least_distance(m, fixed, until);
  const auto overlaps = [&](Real t) {
    const Number d = distance_at(m, fixed, t);
    return d.at < -d.slack;
  };
  if (overlaps(least)) {
    p.surely_meet = true;
    Real low = 0, high = least;
    constexpr int steps = 50;
    for (int i = 0; i < steps && !p.surely_start_overlapping; ++i) {
      const Real t = 0.5L * (low + high);
      (overlaps(t) ? high : low) = t;
    }
    p.by = p.surely_start_overlapping ? 0 : high;
  }
  const Real about = p.surely_meet ? p.by : least;
  const auto consider = [&](const Point& u) { p.not_before = std::max(p.not_before, not_before_along(m, fixed, u)); };
  const auto away_at = [&](Real t) { return minus(m.at(t), fixed.nearest(m.at(t))); };
  const Real speed = length(m.velocity.at);
  consider(away_at(0));
  for (int k = 0; k < 40; k += 2) {
    consider(away_at(about * (1 - std::ldexp(Real(1), -k))));
    // For a motion past a body and away from it: a direction tilted along the motion.
    const Point away = away_at(least);
    if (speed > 0) consider(plus(away, m.velocity.at, std::ldexp(length(away) / speed, -k)));
  }
  p.surely_never = p.not_before == infinite || p.not_before > until;
  return p;
}

}  // namespace nearmiss::bodies
