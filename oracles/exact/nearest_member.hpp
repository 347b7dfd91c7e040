/// The distance of a given answer from the nearest of infinitely many right answers: the unit vectors of a cone, the
/// places that belong to such a normal, the points of a patch, the weights of a triangle without area.
///
/// Distances are in the maximum norm and in units in the last place (ulps) of the largest number of the vector, given
/// or right. The distance of several vectors together is the largest of theirs. Each result is a proved range: its
/// lower end is never above the distance, its upper end never below it. Up to one ulp, where the answer is right, the
/// lower end is 0.
#pragma once

#include <optional>
#include <vector>

#include "impl/catalogue/answer.hpp"
#include "oracles/exact/arithmetic.hpp"
#include "oracles/exact/enclosure.hpp"

namespace nearmiss::oracle {

/// A vector of the given answer. Each component is the sum of `high` and `low`, known within `slack`. A component that
/// the answer does not give may have any value. An infinite component stands for every number beyond the largest finite
/// one.
struct GivenVector {
  std::array<double, 3> high{}, low{};
  std::array<bool, 3> given{};
  double slack = 0;
  Scalar scalar = Scalar::float64;
};

// The exact stage bisects on the distance. Rational arithmetic decides whether some member lies within it.

using RationalVector = std::array<Rational, 3>;

/// direction . x <= 0 or, if `level`, direction . x = 0. The direction may have any length.
struct Side {
  RationalVector direction;
  bool level;
};

/// The set of all x that satisfy every side.
using Cone = std::vector<Side>;

/// With the normal n, the right place is base + reach n.
struct NormalOffset {
  GivenVector place;
  RationalVector base;
  Rational reach;
};

/// With the point x of a polygon, the right place is x + offset. The slack of the given place covers that of the
/// offset.
struct PointOffset {
  GivenVector place;
  RationalVector offset;
};

/// The distance in ulps, and a member within its upper end. No member if the lower end reaches the largest distance
/// that is searched.
struct NearestNormal {
  Bounds ulps;
  std::optional<Vector<Exact>> member;
};
struct NearestPoint {
  Bounds ulps;
  std::optional<RationalVector> member;
};

/// A unit vector of the cone; along a coordinate axis if possible.
Vector<Exact> some_normal(const Cone& cone);
/// The unit vector of the cone, if it contains exactly one.
std::optional<Vector<Exact>> only_normal(const Cone& cone);
/// The nearest unit vector of the cone, which must contain one.
NearestNormal nearest_normal(const GivenVector& given, const Cone& cone);
/// The same for the normal together with its place.
NearestNormal nearest_normal(const GivenVector& given, const Cone& cone, const NormalOffset& lever);
/// A normal n of a cone and a number t of [0, 1], with the places base + reach n + t along.
struct NearestTuple {
  Bounds ulps;
  struct Member {
    Vector<Exact> normal;
    Rational t;
  };
  std::optional<Member> member;  ///< with `along` any one of them, not within the upper end
};
/// The nearest of them. `along` is zero, or perpendicular to each normal of the cone. Where it is not zero, the lower
/// end of the distance may be too small, by the distance that a change of t within the range that it leaves can
/// explain, and the upper end is infinite.
NearestTuple nearest_tuple(const GivenVector& normal, const Cone& cone, const std::vector<NormalOffset>& places,
                           const RationalVector& along);
/// The nearest point of a convex polygon. Two corners form a segment, one corner a point.
NearestPoint nearest_in_polygon(const GivenVector& given, const std::vector<RationalVector>& corners);
/// The same for several places of one point.
NearestPoint nearest_in_polygon(const std::vector<PointOffset>& places, const std::vector<RationalVector>& corners);

// The interval stage: lower bounds, each from one equation or inequality that every member satisfies. The rounding mode
// must be upward. No bound exceeds `far_ulps`.

double far_ulps(Scalar scalar);
/// The unit of the last place of each vector within `far_ulps` of the given one, at most.
double near_unit(const GivenVector& given);
bool all_finite(const GivenVector& given);
Vector<Interval> enclosed(const GivenVector& given);
/// The distance in ulps of the given numbers from those of a member, where a quantity differs by `apart` and changes by
/// at most `per_ulp` for each ulp.
double ulps_across(double apart, const Interval& per_ulp, Scalar scalar);

/// direction . (x - from) lies within `value` for every member x.
struct Form {
  Vector<Interval> direction, from;
  Interval value;
};
double least_ulps(const GivenVector& given, const Form& form);
/// Every member has this distance from the point.
double least_ulps(const GivenVector& given, const Vector<Interval>& point, const Interval& distance);
/// Every member is a unit normal n with the place base + reach n.
double least_ulps_together(const GivenVector& normal, const GivenVector& place, const Vector<Interval>& base,
                           const Interval& reach);

}  // namespace nearmiss::oracle
