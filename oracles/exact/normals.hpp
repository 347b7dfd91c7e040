/// Sets of right normals, and the distance of a given answer from the nearest member. Only the oracles' .cpp files
/// include it.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "oracles/exact/nearest_member.hpp"

namespace nearmiss::oracle {

/// `direction . normal` lies in [low, high] times the direction's length: [-1, 0], [0, 0] or [0, 1]. The direction may
/// have any length; a zero direction excludes nothing. An exact direction is rational.
template <class N>
struct Facing {
  Vector<N> direction;
  int low, high;
};

/// If `many`, the unit vectors that satisfy `facing`; otherwise the one normal that the answer gives.
template <class N>
struct Normals {
  bool many = false;
  NumberVector<Facing<N>> facing;

  static Normals as_given() { return {}; }
  static Normals any() { return {true, {}}; }
  static Normals cone(NumberVector<Facing<N>> f) { return {true, std::move(f)}; }
  /// Those of them that do not point along a motion: n . velocity <= 0.
  Normals against(const Vector<N>& velocity) const {
    Normals n = *this;
    n.facing.push_back({velocity, -1, 0});
    return n;
  }
};

inline Rational rational(const Exact& x) {
  if (x.is_extended()) throw std::logic_error("oracle: a set of right answers with a square root");
  return x.a0();
}
inline RationalVector rational(const Vector<Exact>& v) { return {rational(v[0]), rational(v[1]), rational(v[2])}; }

inline Cone cone_of(const Normals<Exact>& normals) {
  Cone cone;
  for (const Facing<Exact>& f : normals.facing) {
    cone.push_back({rational(f.low == 0 ? negated(f.direction) : f.direction), f.low == f.high});
  }
  return cone;
}

/// A set of many normals, if it is one direction after all.
inline std::optional<Vector<Exact>> only_normal(const Normals<Exact>& normals) {
  return normals.many ? only_normal(cone_of(normals)) : std::nullopt;
}

/// The smaller of two distances.
inline Bounds nearer(const Bounds& a, const Bounds& b) { return {std::min(a.low, b.low), std::min(a.high, b.high)}; }

/// The distance, in ulps, of the given normal from the nearest right one, in whichever form of the normal is nearest.
inline Bounds ulps_from(const NumberVector<GivenVector>& given, const Normals<Exact>& normals) {
  const Cone cone = cone_of(normals);
  Bounds least{HUGE_VAL, HUGE_VAL};
  for (const GivenVector& g : given) {
    least = nearer(least, nearest_normal(g, cone).ulps);
    if (least.low == 0) break;
  }
  return least;
}
inline Bounds ulps_from(const NumberVector<GivenVector>& given, const Normals<Interval>& normals) {
  const Vector<Interval> origin{Interval(0), Interval(0), Interval(0)};
  double least = HUGE_VAL;
  for (const GivenVector& g : given) {
    double of_this = least_ulps(g, origin, Interval(1));
    for (const Facing<Interval>& f : normals.facing) {
      const Interval side(f.low < 0 ? -HUGE_VAL : 0.0, f.high > 0 ? HUGE_VAL : 0.0);
      of_this = std::max(of_this, least_ulps(g, {f.direction, origin, side}));
    }
    least = std::min(least, of_this);
  }
  return {least, HUGE_VAL};
}

}  // namespace nearmiss::oracle
