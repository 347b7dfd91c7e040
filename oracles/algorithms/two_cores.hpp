/// The parts of the truth about two cores that signed distances and casts share: the directions of the greatest gap,
/// the common points of features, enclosures of distances and normals, and what every right answer has.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "oracles/algorithms/furthest.hpp"
#include "oracles/algorithms/near_points.hpp"
#include "oracles/algorithms/rounded_polytopes.hpp"
#include "oracles/algorithms/tuples.hpp"
#include "oracles/exact/wide.hpp"

namespace nearmiss::oracle {

/// A query of the grid about a shape and a half-space.
template <template <class> class Q, class N>
concept WithHalfSpace = std::same_as<decltype(Q<N>::b), collide::HalfSpace<N>>;

inline constexpr std::size_t normal_at = begin_of<collide::SignedDistance<double>>("normal");
inline constexpr std::size_t point1_at = begin_of<collide::SignedDistance<double>>("point1");
inline constexpr std::size_t point2_at = begin_of<collide::SignedDistance<double>>("point2");

/// The answer with a normal, the distance of the cores along it, and their points.
template <class N>
collide::SignedDistance<N> signed_distance_answer(const Core<N>& a, const Core<N>& b, const N& distance,
                                                  const Vector<N>& normal, const Vector<N>& c1, const Vector<N>& c2) {
  return {distance - (a.radius + b.radius), answer_vector(normal), answer_vector(plus(c1, times(normal, a.radius))),
          answer_vector(minus(c2, times(normal, b.radius)))};
}

// Exact numbers.

/// { x : out . x <= level }, or where that is equal.
struct Bound {
  ExactVector out;
  Exact level;
  bool level_only = false;
};

/// The convex hull of points in one plane, as bounds.
inline std::vector<Bound> bounds_of_hull(const std::vector<ExactVector>& points) {
  std::vector<Bound> all;
  const ExactVector& first = points.front();
  const auto level_at_first = [&](const ExactVector& out) { all.push_back({out, dot(out, first), true}); };
  const std::array<ExactVector, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  ExactVector along{0, 0, 0}, across{0, 0, 0};
  for (const ExactVector& x : points) {
    if (surely_zero(norm2(along))) along = minus(x, first);
    if (surely_zero(norm2(across))) across = cross(along, minus(x, first));
  }
  if (surely_zero(norm2(along))) {
    for (const ExactVector& axis : axes) level_at_first(axis);
    return all;
  }
  const auto bound_along = [&](const ExactVector& out) {
    Exact most = dot(out, first);
    for (const ExactVector& x : points) most = -lesser(Exact(-most), Exact(-dot(out, x)));
    all.push_back({out, most});
  };
  if (surely_zero(norm2(across))) {
    for (const ExactVector& axis : axes) level_at_first(cross(along, axis));
    bound_along(along), bound_along(negated(along));
    return all;
  }
  level_at_first(across);
  for (const ExactVector& x : points) {
    for (const ExactVector& y : points) {
      const ExactVector out = cross(minus(y, x), across);
      const Exact level = dot(out, x);
      if (!surely_zero(norm2(out)) && std::none_of(points.begin(), points.end(), [&](const ExactVector& z) {
            return may_be_less(level, dot(out, z));
          }))
        all.push_back({out, level});
    }
  }
  return all;
}

/// The part of a convex polygon, whose corners are in order, within a bound. Two corners form a segment.
inline std::vector<ExactVector> part_within(const std::vector<ExactVector>& polygon, const ExactVector& out,
                                            const Exact& level) {
  std::vector<ExactVector> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ExactVector &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Exact of_a = dot(out, a) - level, of_b = dot(out, b) - level;
    if (!may_be_positive(of_a)) kept.push_back(a);
    if (may_be_negative(Exact(of_a * of_b))) kept.push_back(plus(a, times(minus(b, a), Exact(of_a / (of_a - of_b)))));
  }
  return kept;
}
/// The corners of the common part of two convex polygons, each once; those of the first are in order.
inline std::vector<ExactVector> common_part(std::vector<ExactVector> of, const std::vector<ExactVector>& with) {
  for (const Bound& bound : bounds_of_hull(with)) {
    of = part_within(of, bound.out, bound.level);
    if (bound.level_only) of = part_within(of, negated(bound.out), Exact(-bound.level));
  }
  std::vector<ExactVector> once;
  for (ExactVector& x : of) {
    if (std::none_of(once.begin(), once.end(), [&](const ExactVector& y) { return surely_zero(norm2(minus(x, y))); }))
      once.push_back(std::move(x));
  }
  return once;
}

/// The ends of points on one line, in the order of the points. Of at most two points, these.
inline std::vector<ExactVector> ends_of(const std::vector<ExactVector>& on_line) {
  if (on_line.size() < 3) return on_line;
  const ExactVector along = minus(on_line[1], on_line[0]);
  const auto is_before = [&](const ExactVector& x, const ExactVector& y) {
    return may_be_less(dot(along, x), dot(along, y));
  };
  const auto [first, last] = std::minmax_element(on_line.begin(), on_line.end(), is_before);
  return first < last ? std::vector{*first, *last} : std::vector{*last, *first};
}

/// The right answers with one normal, of length 1, along which the cores are apart by this distance, and the way
/// between their points. `corners` are those of the polygon of first points.
template <class Out>
void report_along_normal(const ExactCore& a, const ExactCore& b, const ExactVector& normal, const Exact& distance,
                         const ExactVector& way, const std::vector<ExactVector>& corners, Out& out) {
  const auto answer = [&](const ExactVector& c) {
    return signed_distance_answer(a, b, distance, normal, c, plus(c, way));
  };
  for (const ExactVector& c : corners) out.yes(answer(c));
  if (corners.size() == 1 || !out.compares_yes()) return;
  std::vector<PointOffset> places{offset_place(out, point1_at, times(normal, a.radius)),
                                  offset_place(out, point2_at, minus(way, times(normal, b.radius)))};
  std::vector<RationalVector> polygon;
  for (const ExactVector& c : corners) {
    const NearRational near = near_rational(c);
    polygon.push_back(near.vector);
    for (PointOffset& p : places) p.place.slack += near.slack;
  }
  const NearestPoint both = nearest_in_polygon(places, polygon);
  const NearestPoint first = nearest_in_polygon({places[0]}, polygon),
                     second = nearest_in_polygon({places[1]}, polygon);
  const RationalVector& x = both.member ? *both.member : polygon.front();
  out.yes(answer({Exact(x[0]), Exact(x[1]), Exact(x[2])}),
          SetDistance{{{point1_at, first.ulps}, {point2_at, second.ulps}}, both.ulps});
}

/// Where the features furthest along a normal meet when the second one is moved by the opposite of the way.
inline std::vector<ExactVector> first_points(const ExactCore& a, const ExactCore& b, const ExactVector& normal,
                                             const ExactVector& way) {
  std::vector<ExactVector> of_b = furthest(b, negated(normal));
  for (ExactVector& v : of_b) v = minus(v, way);
  return common_part(furthest(a, normal), of_b);
}

/// The same for a direction of any length whose gap, times that length, is `gap`. corners_of(way) are those of the
/// polygon of first points.
template <class Out, class CornersOf>
void report_along(const ExactCore& a, const ExactCore& b, const ExactVector& direction, const Exact& gap, Out& out,
                  CornersOf&& corners_of) {
  const Exact length2 = norm2(direction), inverse = root(Exact(Exact(1) / length2));
  const ExactVector way = times(direction, Exact(gap / length2));
  report_along_normal(a, b, times(direction, inverse), Exact(gap * inverse), way, corners_of(way), out);
}

/// The same for two cores.
template <class Out>
void report_along(const ExactCore& a, const ExactCore& b, const ExactVector& direction, const Exact& gap, Out& out) {
  report_along(a, b, direction, gap, out, [&](const ExactVector& way) { return first_points(a, b, direction, way); });
}

/// The cores meet in a point or a segment, on which these points of a line are: each normal of a cone is right, with
/// each common point. With `along_way`, each that does not point against it.
template <class Out>
void report_touch(const ExactCore& a, const ExactCore& b, const std::vector<ExactVector>& common, Out& out,
                  const ExactVector* along_way = nullptr) {
  const std::vector<ExactVector> corners = ends_of(common);
  Normals<Exact> normals = Normals<Exact>::any();
  if (along_way != nullptr) normals.facing.push_back({*along_way, 0, 1});
  const auto add = [&normals](const ExactVector& way) {
    if (!surely_zero(norm2(way))) normals.facing.push_back({way, 0, 1});
  };
  for (const ExactVector& v : a.vertices) add(minus(corners.front(), v));
  for (const ExactVector& w : b.vertices) add(minus(w, corners.front()));
  const Cone cone = cone_of(normals);
  const auto answer = [&](const ExactVector& n, const ExactVector& c) {
    return signed_distance_answer(a, b, Exact(0), n, c, c);
  };
  const ExactVector some = some_normal(cone);
  for (const ExactVector& c : corners) out.yes(answer(some, c));
  if (only_normal(cone) && corners.size() == 1) return;
  if (!out.compares_yes()) {  // for people, one more
    for (int axis = 0; axis < 3; ++axis) {
      for (const int sign : {1, -1}) {
        ExactVector n{0, 0, 0};
        n[axis] = Exact(sign);
        const bool is_right = std::none_of(normals.facing.begin(), normals.facing.end(), [&](const Facing<Exact>& f) {
          return may_be_negative(dot(f.direction, n));
        });
        if (is_right && !surely_zero(norm2(minus(n, some)))) return out.yes(answer(n, corners.front()));
      }
    }
    return;
  }
  const RationalVector base = rational(corners.front()), along = rational(minus(corners.back(), corners.front()));
  const std::vector<NormalOffset> places{{out.given_vector(point1_at).front(), base, rational(a.radius)},
                                         {out.given_vector(point2_at).front(), base, rational(Exact(-b.radius))}};
  const auto nearest = [&](const std::vector<NormalOffset>& to, bool with_normal) {
    GivenVector nothing;
    nothing.scalar = places[0].place.scalar;
    if (!with_normal) return nearest_tuple(nothing, cone, to, along);
    NearestTuple best;
    best.ulps = {HUGE_VAL, HUGE_VAL};
    for (const GivenVector& n : out.given_vector(normal_at)) {
      NearestTuple of_form = nearest_tuple(n, cone, to, along);
      if (of_form.ulps.low < best.ulps.low) best.member = of_form.member;
      best.ulps = nearer(best.ulps, of_form.ulps);
    }
    return best;
  };
  const NearestTuple all = nearest(places, true);
  const ExactVector& n = all.member ? all.member->normal : some;
  const ExactVector c = plus(
      corners.front(), times(minus(corners.back(), corners.front()), Exact(all.member ? all.member->t : Rational(0))));
  out.yes(answer(n, c));
  out.yes(answer(n, c), SetDistance{{{normal_at, ulps_from(out.given_vector(normal_at), normals)},
                                     {point1_at, nearest({places[0]}, false).ulps},
                                     {point2_at, nearest({places[1]}, false).ulps}},
                                    all.ulps});
}

/// A direction in which the cores are apart by the most, and the gap, times the direction's length.
struct Separating {
  ExactVector direction;
  Exact gap, rank;  ///< the rank grows with gap / |direction|
};
/// All of them, each once. None where every direction is zero: two points are equal.
inline std::vector<Separating> greatest_gaps(const ExactCore& a, const ExactCore& b) {
  std::vector<Separating> best;
  const auto compare = [&](const ExactVector& d, TwoEdges<Exact>) {
    const Exact length2 = norm2(d);
    if (surely_zero(length2)) return false;
    const std::array<Exact, 2> both = gaps(d, a, b);
    for (const int side : {0, 1}) {
      const Exact& gap = both[std::size_t(side)];
      const Exact square_of_gap = square(gap);
      Separating s{side == 0 ? d : negated(d), gap,
                   Exact((may_be_negative(gap) ? Exact(-square_of_gap) : square_of_gap) / length2)};
      if (!best.empty() && may_be_less(s.rank, best.front().rank)) continue;
      if (!best.empty() && may_be_less(best.front().rank, s.rank)) best.clear();
      const bool is_new = std::none_of(best.begin(), best.end(), [&](const Separating& other) {
        return surely_zero(norm2(cross(other.direction, s.direction))) &&
               may_be_positive(dot(other.direction, s.direction));
      });
      if (is_new) best.push_back(std::move(s));
    }
    return false;
  };
  const std::vector<bool> may_be = directions_of_greatest_gap(a, b);
  any_direction(a, b, false, compare, [&, i = std::size_t(0)]() mutable { return may_be[i++]; });
  return best;
}
/// Whether they are those of cores that touch or cross without a volume in common.
inline bool is_touch(const std::vector<Separating>& best, const ExactCore& a, const ExactCore& b) {
  return best.empty() || surely_zero(best.front().gap) || (may_be_negative(best.front().gap) && !surely_spans(a, b));
}

/// The right answers about two cores with these greatest gaps. With `along_way`, of cores that touch, those whose
/// normals do not point against it.
template <class Out>
void report_tuples(const ExactCore& a, const ExactCore& b, const std::vector<Separating>& best, Out& out,
                   const ExactVector* along_way = nullptr) {
  if (best.empty() || (may_be_negative(best.front().gap) && !surely_spans(a, b)))
    return report_touch(a, b, common_part(in_order(a.vertices), in_order(b.vertices)), out, along_way);
  const bool touch = surely_zero(best.front().gap);
  // The edges of the cone of normals are normals of facets, and those are among the best.
  const bool has_one_normal = best.size() == 1 && surely_spans(a, b);
  if (touch && !has_one_normal) {
    const ExactVector& n = best.front().direction;
    const std::vector<ExactVector> common = common_part(furthest(a, n), furthest(b, negated(n)));
    if (common.size() < 3) return report_touch(a, b, common, out, along_way);
  }
  for (const Separating& s : best) {
    if (touch && along_way != nullptr && may_be_negative(dot(s.direction, *along_way))) continue;
    report_along(a, b, s.direction, s.gap, out);
  }
}
// Intervals.

/// A lower bound of the distance of the cores: any direction gives one.
inline double least_distance(const IntervalCore& a, const IntervalCore& b) {
  double least = 0;
  any_direction(a, b, false, [&](const IntervalVector& d, TwoEdges<Interval>) {
    for (const Interval& gap : gaps(d, a, b)) {
      if (gap.inf() > 0) least = std::max(least, (of_bound(gap.inf()) / of_bound(root(norm2(d)).sup())).inf());
    }
    return false;
  });
  return least;
}

/// The gap of the cores in a direction of about unit length, at most.
inline double most_gap(const IntervalVector& direction, const IntervalCore& a, const IntervalCore& b) {
  return gaps(direction, a, b)[0].sup();
}

/// Encloses the signed distances within which those of all inputs lie, where that of some inputs is `s`, and their
/// cores are these: each changes by at most as much as the vertices move.
inline Interval widened_by(const Bounds& s, const IntervalCore& a, const IntervalCore& b, const IntervalCore& some_a,
                           const IntervalCore& some_b) {
  const auto without_radius = [](IntervalCore core) {
    core.radius = Interval(0);
    return core;
  };
  const Interval reach = of_bound(movement(without_radius(a), without_radius(some_a))) +
                         of_bound(movement(without_radius(b), without_radius(some_b)));
  return {(of_bound(s.low) - reach).inf(), (of_bound(s.high) + reach).sup()};
}

inline IntervalVector in_the_middle(IntervalVector x) {
  for (Interval& c : x) c = Interval(CGAL::to_double(c));
  return x;
}
/// A core with vertices near those of an input in the middle of the others. That of a box has edges that are
/// perpendicular but for rounding.
inline IntervalCore in_the_middle(const IntervalCore& core) {
  if (!core.reach.empty()) {
    std::array<IntervalVector, 3> reach;
    for (std::size_t k = 0; k < 3; ++k) reach[k] = in_the_middle(core.reach[k]);
    return parallelepiped(in_the_middle(core.center), reach);
  }
  std::vector<IntervalVector> vertices;
  for (const IntervalVector& v : core.vertices) vertices.push_back(in_the_middle(v));
  if (vertices.size() > 1) return flat_core(std::move(vertices));
  IntervalCore middle;
  middle.vertices = std::move(vertices);
  return middle;
}

/// Encloses the signed distances of the cores of all inputs. By exact numbers where the intervals know a direction
/// poorly, unless the oracle reports in other units: then `inputs` is empty.
template <template <class> class Q>
inline Interval distance_of_all(const Q<Interval>& q, const IntervalCore& a, const IntervalCore& b,
                                std::span<const double> inputs) {
  const IntervalCore mid_a = in_the_middle(a), mid_b = in_the_middle(b);
  if (const std::optional<Bounds> s = signed_distance(mid_a, mid_b)) return widened_by(*s, a, b, mid_a, mid_b);
  if (inputs.empty()) return {-HUGE_VAL, HUGE_VAL};
  const std::vector<double> middle = without_tiny_numbers<Q<double>>(inputs);
  const auto some = inputs_at<Q<Interval>>(middle);
  return widened_by(exact_signed_distance<Q>(middle), core_of(q.a), core_of(q.b), core_of(some.a), core_of(some.b));
}

/// How far the given answer is from a right one at least, by properties that every right answer has: its normal n has
/// the greatest gap; p1 - rA n and p2 + rB n are points of the cores; p2 - p1 = s n.
struct Proofs {
  double normal = 0, point1 = 0, point2 = 0, together = 0;
};

template <class Out>
class GivenAnswer {
 public:
  /// The cores are relative to the place.
  GivenAnswer(const IntervalCore& a, const IntervalCore& b, const IntervalVector& place, const Interval& distance,
              const Out& out)
      : a_(a),
        b_(b),
        distance_(distance),
        normals_(out.given_vector(normal_at)),
        p1_(out.given_vector(point1_at).front()),
        p2_(out.given_vector(point2_at).front()),
        at1_(relative_to_place(p1_, place)),
        at2_(relative_to_place(p2_, place)) {
    proofs_.point1 = ulps_of_place(p1_, at1_, a_);
    proofs_.point2 = ulps_of_place(p2_, at2_, b_);
    proofs_.normal = proofs_.together = HUGE_VAL;
    for (const GivenVector& n : normals_) {  // in the nearer of its forms
      const double of_form = ulps_of_normal(n);
      proofs_.normal = std::min(proofs_.normal, of_form);
      proofs_.together = std::min(proofs_.together, std::max(of_form, ulps_together(n)));
    }
    proofs_.together = std::max({proofs_.together, proofs_.point1, proofs_.point2});
  }

  /// For right answers whose normals lie within `normal`, and are perpendicular to the directions of the edges, if any.
  SetDistance from(const IntervalVector& normal, const TwoEdges<Interval>& edges) const {
    const IntervalVector origin{Interval(0), Interval(0), Interval(0)};
    double of_normal = HUGE_VAL;
    for (const GivenVector& n : normals_) {
      double of_form = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        IntervalVector axis = origin;
        axis[k] = Interval(1);
        of_form = std::max(of_form, least_ulps(n, {axis, origin, normal[k]}));
      }
      for (const IntervalVector* d : {edges.of_a, edges.of_b}) {
        if (d != nullptr) of_form = std::max(of_form, least_ulps(n, {*d, origin, Interval(0)}));
      }
      of_normal = std::min(of_normal, of_form);
    }
    of_normal = std::max(of_normal, proofs_.normal);
    SetDistance set{{{point1_at, {proofs_.point1, HUGE_VAL}}, {point2_at, {proofs_.point2, HUGE_VAL}}},
                    {std::max(of_normal, proofs_.together), HUGE_VAL}};
    if (all_finite(normals_.front())) set.vectors.push_back({normal_at, {of_normal, HUGE_VAL}});
    return set;
  }

 private:
  /// Not used where the given numbers are not finite.
  static IntervalVector relative_to_place(const GivenVector& given, const IntervalVector& place) {
    return all_finite(given) ? minus(enclosed(given), place) : place;
  }
  static IntervalCore core_at(const IntervalVector& x) {
    IntervalCore core;
    core.vertices = {x};
    return core;
  }
  Interval per_ulp_of(const GivenVector& v) const { return root(Interval(3)) * near_unit(v); }
  /// No point of the body is further from its core than the radius.
  double ulps_of_place(const GivenVector& given, const IntervalVector& at, const IntervalCore& core) const {
    if (!all_finite(given)) return 0;
    const double apart = (of_bound(least_distance(core_at(at), core)) - core.radius).inf();
    return ulps_across(apart, per_ulp_of(given), given.scalar);
  }
  double ulps_of_normal(const GivenVector& n) const {
    if (!all_finite(n)) return 0;
    double furthest = 0;
    for (const IntervalVector& v : a_.vertices) {
      for (const IntervalVector& w : b_.vertices) furthest = std::max(furthest, root(norm2(minus(w, v))).sup());
    }
    const double missing = (of_bound(distance_.inf()) - of_bound(most_gap(enclosed(n), a_, b_))).inf();
    return ulps_across(missing, of_bound(furthest) * per_ulp_of(n), n.scalar);
  }
  double ulps_together(const GivenVector& n) const {
    if (!all_finite(n) || !all_finite(p2_)) return 0;
    if (!all_finite(p1_)) return ulps_of_second(n);
    const IntervalVector normal = enclosed(n), c1 = minus(at1_, times(normal, a_.radius)),
                         c2 = plus(at2_, times(normal, b_.radius));
    const Interval per_ulp1 = per_ulp_of(p1_) + a_.radius * per_ulp_of(n),
                   per_ulp2 = per_ulp_of(p2_) + b_.radius * per_ulp_of(n);
    double least = std::max(ulps_across(least_distance(core_at(c1), a_), per_ulp1, n.scalar),
                            ulps_across(least_distance(core_at(c2), b_), per_ulp2, n.scalar));
    const Interval distance = distance_ - (a_.radius + b_.radius);
    const Interval per_ulp =
        of_bound(near_unit(p1_)) + of_bound(near_unit(p2_)) + magnitude(distance) * of_bound(near_unit(n));
    for (std::size_t k = 0; k < 3; ++k) {
      const Interval off = at2_[k] - at1_[k] - distance * normal[k];
      least = std::max(least, ulps_across(bounds(off).nearest_to_zero(), per_ulp, n.scalar));
    }
    return least;
  }

  /// Of the second point alone.
  double ulps_of_second(const GivenVector& n) const {
    const IntervalVector c2 = plus(at2_, times(enclosed(n), b_.radius));
    return ulps_across(least_distance(core_at(c2), b_), per_ulp_of(p2_) + b_.radius * per_ulp_of(n), n.scalar);
  }

  const IntervalCore &a_, &b_;
  const Interval distance_;
  const NumberVector<GivenVector> normals_;
  const GivenVector p1_, p2_;
  const IntervalVector at1_, at2_;
  Proofs proofs_;
};

/// Where two lines along edges of the cores are nearest: the point of the first one. Empty where the intervals cannot
/// tell.
inline std::optional<IntervalVector> nearest_on_first(const IntervalVector& at1, const IntervalVector& along1,
                                                      const IntervalVector& at2, const IntervalVector& along2) {
  const IntervalVector across = cross(along1, along2);
  const Interval length2 = norm2(across);
  if (!(length2.inf() > 0)) return std::nullopt;
  const Interval t = dot(cross(minus(at2, at1), along2), across) / length2;
  return plus(at1, times(along1, t));
}

/// Narrows a point of the core to those that are nearest to a point, by a segment's equation. The point is nearest to
/// it where the cores are apart.
inline IntervalVector nearest_to(const IntervalVector& to, const IntervalCore& core, IntervalVector point) {
  if (core.vertices.size() != 2) return point;
  for (const auto& [from, other] : {std::pair(0, 1), std::pair(1, 0)}) {
    const IntervalVector along = minus(core.vertices[std::size_t(other)], core.vertices[std::size_t(from)]);
    const Interval length2 = norm2(along);
    if (!(length2.inf() > 0)) return point;
    const Interval t = assume_within(dot(minus(to, core.vertices[std::size_t(from)]), along) / length2, 0.0, 1.0);
    point = within_both(point, plus(core.vertices[std::size_t(from)], times(along, t)));
  }
  return point;
}

/// Whether the Minkowski difference never has a volume: that of two segments, or of a point and a triangle.
inline bool is_difference_flat(const IntervalCore& a, const IntervalCore& b) {
  const auto dimensions = [](const IntervalCore& core) { return core.vertices.size() - 1; };
  return dimensions(a) + dimensions(b) <= 2;
}

/// Encloses the normal by the boxes that the points of the way lie in.
inline IntervalVector normal_between(const IntervalVector& from, const IntervalVector& to, const Interval& distance,
                                     const IntervalVector& normal) {
  if (!(distance.inf() > 0)) return normal;
  IntervalVector between = times(minus(to, from), Interval(Interval(1) / distance));
  for (Interval& x : between) x = assume_within(x, -1.0, 1.0);
  return within_both(normal, between);
}

/// Encloses the right normals of cores at this distance from each other. With points of both at the ends of `way`, each
/// right normal n has n . way >= distance: it lies in a cone around the way.
inline IntervalVector normals_around(const IntervalVector& way, const Interval& distance) {
  const Interval any(-1, 1), length = root(norm2(way));
  if (!(distance.inf() > 0 && length.inf() > 0 && length.sup() < HUGE_VAL)) return {any, any, any};
  const double cosine = std::min(1.0, (of_bound(distance.inf()) / of_bound(length.sup())).inf());
  const double sine = root(Interval(1) - square(of_bound(cosine))).sup();
  IntervalVector normal = unit_of(way);
  for (Interval& x : normal)
    x = assume_within(Interval(cosine, 1) * x + Interval(-sine, sine) * root(Interval(1) - square(x)), -1.0, 1.0);
  return normal;
}
/// The same for points of the cores near to each other.
inline IntervalVector normals_of(const IntervalCore& a, const IntervalCore& b, const Interval& distance) {
  const Interval any(-1, 1);
  if (!(distance.inf() > 0)) return {any, any, any};
  const NearPoints near(a, b);
  if (!near.weights()) return {any, any, any};
  const auto& [of_a, of_b] = *near.weights();
  return normals_around(minus(point_at(spans_of(b), of_b), point_at(spans_of(a), of_a)), distance);
}

/// Encloses the right answers about two cores, relative to the place, that are apart by this distance.
template <class Out>
void report_tuples(const IntervalCore& a, const IntervalCore& b, const IntervalVector& place, const Interval& distance,
                   Out& out) {
  const bool has_no_volume = is_difference_flat(a, b);
  const GivenAnswer<Out> given(a, b, place, distance, out);
  const auto answer = [&](const Interval& s, const IntervalVector& n, const IntervalVector& c1,
                          const IntervalVector& c2) {
    return signed_distance_answer(a, b, s, n, plus(c1, place), plus(c2, place));
  };
  const IntervalVector any_normal = normals_of(a, b, distance);
  const auto everywhere = [](const IntervalVector&) { return true; };
  const auto report_loosely = [&](const TwoEdges<Interval>& edges) {
    IntervalVector c1 = hull_of(a, everywhere), c2 = hull_of(b, everywhere);
    if (distance.inf() > 0) {
      c2 = nearest_to(c1, b, c2);
      c1 = nearest_to(c2, a, c1);
    }
    const IntervalVector n = normal_between(c1, c2, distance, any_normal);
    out.yes(answer(distance, n, c1, c2), given.from(n, edges));
  };
  if (distance.inf() <= 0 && distance.sup() >= 0) report_loosely({});  // a cone of normals
  if (distance.sup() <= 0 && has_no_volume) return;
  any_direction(a, b, false, [&](const IntervalVector& d, const TwoEdges<Interval>& edges) {
    const Interval length = root(norm2(d));
    if (surely_zero(length)) return false;
    if (!(length.inf() > 0 && length.sup() < HUGE_VAL)) {
      report_loosely(edges);
      return false;
    }
    const auto both = gaps(d, a, b);
    for (const std::size_t side : {0, 1}) {
      Interval s = both[side] / length;
      if (!narrow(s, distance)) continue;
      IntervalVector n = unit_of(side == 0 ? d : negated(d));
      if (!narrow(n[0], any_normal[0]) || !narrow(n[1], any_normal[1]) || !narrow(n[2], any_normal[2])) continue;
      const IntervalVector way = times(n, s);
      const IntervalVector of_a = hull_of(a, MayBeFurthest{a, n}), of_b = hull_of(b, MayBeFurthest{b, negated(n)});
      IntervalVector c1 = within_both(of_a, minus(of_b, way)), c2 = within_both(of_b, plus(of_a, way));
      if (edges.of_a != nullptr && a.edges.size() == 1 && b.edges.size() == 1) {
        const IntervalVector &from_a = a.vertices[0], &from_b = b.vertices[0];
        if (const auto on_a = nearest_on_first(from_a, *edges.of_a, from_b, *edges.of_b)) c1 = within_both(c1, *on_a);
        if (const auto on_b = nearest_on_first(from_b, *edges.of_b, from_a, *edges.of_a)) c2 = within_both(c2, *on_b);
      }
      c1 = within_both(c1, minus(c2, way)), c2 = within_both(c2, plus(c1, way));
      if (s.inf() > 0) c1 = nearest_to(c2, a, c1), c2 = nearest_to(c1, b, c2);
      n = normal_between(c1, c2, s, n);
      out.yes(answer(s, n, c1, c2), given.from(n, edges));
    }
    return false;
  });
}

/// Encloses the distances of the cores of all inputs, relative to one place.
template <template <class> class Q>
Interval enclosed_distance(const Q<Interval>& q, const IntervalCore& a, const IntervalCore& b,
                           std::span<const double> middle) {
  const double apart = least_distance(a, b);
  return meet(Interval(is_difference_flat(a, b) || apart > 0 ? apart : -HUGE_VAL, HUGE_VAL),
              distance_of_all<Q>(q, a, b, middle));
}
}  // namespace nearmiss::oracle
