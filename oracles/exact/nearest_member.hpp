/// How far a given answer is from the nearest of a set of right ones, where they are more than can be listed: the unit
/// vectors of a cone, places that go with such a normal, the points of a patch, weights of a triangle without area.
///
/// Distances are in the maximum norm and in units in the last place (ulps): one is that of the largest number of the
/// vector, given or right. Of several vectors together the furthest counts. What is told is a proved range: never more
/// than the distance at its lower end, never less at its upper one. Up to one ulp, where the answer is right, the lower
/// end is 0.
#pragma once

#include <optional>
#include <vector>

#include "impl/catalogue/answer.hpp"
#include "oracles/exact/arithmetic.hpp"
#include "oracles/exact/enclosure.hpp"

namespace nearmiss::oracle {

/// A vector of the given answer: the sums of `high` and `low`, each of them known within `slack`. A number that the
/// answer does not have may be anything; an infinite one stands for every number beyond the largest finite one.
struct GivenVector {
  std::array<double, 3> high{}, low{};
  std::array<bool, 3> given{};
  double slack = 0;
  Scalar scalar = Scalar::float64;
};

// The exact stage: by bisection on the distance. Whether some member is within it is decided in rational numbers.

using RationalVector = std::array<Rational, 3>;

/// direction . x <= 0 or, where `level` says so, = 0. The direction has any length.
struct Side {
  RationalVector direction;
  bool level;
};

/// Where all x that are on each of the sides form the cone.
using Cone = std::vector<Side>;

/// base + reach n is the right place beside the normal n; the reach is not negative.
struct NormalOffset {
  GivenVector place;
  RationalVector base;
  Rational reach;
};

/// The distance in ulps, and a member that is at most the upper end away; none where the lower end is as far as is
/// looked, or further.
struct NearestNormal {
  Bounds ulps;
  std::optional<Vector<Exact>> member;
};
struct NearestPoint {
  Bounds ulps;
  std::optional<RationalVector> member;
};

/// Some unit vector of the cone: along an axis where there is such a one.
Vector<Exact> some_normal(const Cone& cone);
/// Among the unit vectors of the cone, which has some.
NearestNormal nearest_normal(const GivenVector& given, const Cone& cone);
/// The same together with the place.
NearestNormal nearest_normal(const GivenVector& given, const Cone& cone, const NormalOffset& lever);
/// Among the points of a convex polygon; one of two corners is a segment, one of one corner a point.
NearestPoint nearest_in_polygon(const GivenVector& given, const std::vector<RationalVector>& corners);

// The interval stage: lower bounds, each by one equation or inequality that every member satisfies. The rounding mode
// must be upward. `far_ulps` is the most that they tell.

double far_ulps(Scalar scalar);

/// direction . (x - from) lies within `value` for every member x.
struct Form {
  Vector<Interval> direction, from;
  Interval value;
};
double least_ulps(const GivenVector& given, const Form& form);
/// Every member is at that distance from the point.
double least_ulps(const GivenVector& given, const Vector<Interval>& point, const Interval& distance);
/// Every member is a normal n, of length 1, with the place base + reach n.
double least_ulps_together(const GivenVector& normal, const GivenVector& place, const Vector<Interval>& base,
                           const Interval& reach);

}  // namespace nearmiss::oracle
