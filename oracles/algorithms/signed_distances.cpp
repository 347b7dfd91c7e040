/// Truth of the grid's signed distances. That from a half-space is measured against its normal. The signed distance of
/// two cores is the greatest gap between them over all directions of length 1, and each right normal has that gap.
/// Where the cores are apart, or meet in a volume, it is one of the directions of any_direction(). Where they only
/// touch or cross without a volume, each direction that separates them weakly is right: those of a cone, or both
/// normals of a face that is common to them. With a normal n the nearest points c1 and c2 of the cores are any points
/// of theirs with c2 - c1 = gap n, so c1 lies in the common part of a feature of the first and of the moved one of the
/// second: a polygon, or less. The radii move the points along n.
#include <algorithm>

#include "impl/catalogue/queries/grid.hpp"
#include "oracles/algorithms/furthest.hpp"
#include "oracles/algorithms/near_points.hpp"
#include "oracles/algorithms/rounded_polytopes.hpp"
#include "oracles/algorithms/surface_of_shapes.hpp"
#include "oracles/algorithms/tuples.hpp"
#include "oracles/exact/wide.hpp"

namespace nearmiss::oracle {

namespace {

constexpr std::size_t normal_at = begin_of<collide::SignedDistance<double>>("normal");
constexpr std::size_t point1_at = begin_of<collide::SignedDistance<double>>("point1");
constexpr std::size_t point2_at = begin_of<collide::SignedDistance<double>>("point2");

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
std::vector<Bound> bounds_of_hull(const std::vector<ExactVector>& points) {
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
std::vector<ExactVector> part_within(const std::vector<ExactVector>& polygon, const ExactVector& out,
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
std::vector<ExactVector> common_part(std::vector<ExactVector> of, const std::vector<ExactVector>& with) {
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

/// The right answers with one normal, the direction, whose gap is `gap`, both times the direction's length.
/// corners_of(way) are those of the polygon of first points.
template <class Out, class CornersOf>
void report_along(const ExactCore& a, const ExactCore& b, const ExactVector& direction, const Exact& gap, Out& out,
                  CornersOf&& corners_of) {
  const Exact length2 = norm2(direction), inverse = root(Exact(Exact(1) / length2));
  const ExactVector normal = times(direction, inverse), way = times(direction, Exact(gap / length2));
  const std::vector<ExactVector> corners = corners_of(way);
  const auto answer = [&](const ExactVector& c) {
    return signed_distance_answer(a, b, Exact(gap * inverse), normal, c, plus(c, way));
  };
  for (const ExactVector& c : corners) out.yes(answer(c));
  if (corners.size() == 1 || !out.compares_yes()) return;
  const std::vector<PointOffset> places{offset_place(out, point1_at, times(normal, a.radius)),
                                        offset_place(out, point2_at, minus(way, times(normal, b.radius)))};
  std::vector<RationalVector> polygon;
  for (const ExactVector& c : corners) polygon.push_back(rational(c));
  const NearestPoint both = nearest_in_polygon(places, polygon);
  const NearestPoint first = nearest_in_polygon({places[0]}, polygon),
                     second = nearest_in_polygon({places[1]}, polygon);
  const RationalVector& x = both.member ? *both.member : polygon.front();
  out.yes(answer({Exact(x[0]), Exact(x[1]), Exact(x[2])}),
          SetDistance{{{point1_at, first.ulps}, {point2_at, second.ulps}}, both.ulps});
}

/// The same for two cores.
template <class Out>
void report_along(const ExactCore& a, const ExactCore& b, const ExactVector& direction, const Exact& gap, Out& out) {
  report_along(a, b, direction, gap, out, [&](const ExactVector& way) {
    std::vector<ExactVector> of_b = furthest(b, negated(direction));
    for (ExactVector& v : of_b) v = minus(v, way);
    return common_part(furthest(a, direction), of_b);
  });
}

/// The ends of points on one line, in the order of the points. Of at most two points, these.
std::vector<ExactVector> ends_of(const std::vector<ExactVector>& on_line) {
  if (on_line.size() < 3) return on_line;
  const ExactVector along = minus(on_line[1], on_line[0]);
  const auto is_before = [&](const ExactVector& x, const ExactVector& y) {
    return may_be_less(dot(along, x), dot(along, y));
  };
  const auto [first, last] = std::minmax_element(on_line.begin(), on_line.end(), is_before);
  return first < last ? std::vector{*first, *last} : std::vector{*last, *first};
}

/// The cores meet in a point or a segment, on which these points of a line are: each normal of a cone is right, with
/// each common point.
template <class Out>
void report_touch(const ExactCore& a, const ExactCore& b, const std::vector<ExactVector>& common, Out& out) {
  const std::vector<ExactVector> corners = ends_of(common);
  Normals<Exact> normals = Normals<Exact>::any();
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

template <template <class> class Q, class N>
concept WithHalfSpace = std::same_as<decltype(Q<N>::b), collide::HalfSpace<N>>;

/// From a half-space: against its normal, from the vertices that are furthest that way.
template <template <class> class Q, class Out>
  requires WithHalfSpace<Q, Exact>
void signed_distance_of(const Q<Exact>& q, Out& out) {
  const ExactCore a = in_units(core_of(q.a));
  const ExactVector outward = vector(q.b.normal), direction = negated(outward);
  if (surely_zero(norm2(outward))) return out.everything();
  const std::vector<ExactVector> deepest = furthest(a, direction);
  ExactCore without_radius;
  report_along(a, without_radius, direction, Exact(dot(outward, deepest.front()) + q.b.offset), out,
               [&](const ExactVector&) { return deepest; });
}

template <template <class> class Q, class Out>
void signed_distance_of(const Q<Exact>& q, Out& out) {
  const ExactCore a = in_units(core_of(q.a)), b = in_units(core_of(q.b));
  struct Separating {
    ExactVector direction;
    Exact gap, rank;  ///< the rank grows with gap / |direction|
  };
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
  if (best.empty() || (may_be_negative(best.front().gap) && !surely_spans(a, b)))
    return report_touch(a, b, common_part(in_order(a.vertices), in_order(b.vertices)), out);
  if (surely_zero(best.front().gap)) {
    const ExactVector& n = best.front().direction;
    const std::vector<ExactVector> common = common_part(furthest(a, n), furthest(b, negated(n)));
    if (common.size() < 3) return report_touch(a, b, common, out);
  }
  for (const Separating& s : best) report_along(a, b, s.direction, s.gap, out);
}

// Intervals.

/// A lower bound of the distance of the cores: any direction gives one.
double least_distance(const IntervalCore& a, const IntervalCore& b) {
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
double most_gap(const IntervalVector& direction, const IntervalCore& a, const IntervalCore& b) {
  return gaps(direction, a, b)[0].sup();
}

/// Encloses the signed distances within which those of all inputs lie, where that of some inputs is `s`, and their
/// cores are these: each changes by at most as much as the vertices move.
Interval widened_by(const Bounds& s, const IntervalCore& a, const IntervalCore& b, const IntervalCore& some_a,
                    const IntervalCore& some_b) {
  const auto without_radius = [](IntervalCore core) {
    core.radius = Interval(0);
    return core;
  };
  const Interval reach = of_bound(movement(without_radius(a), without_radius(some_a))) +
                         of_bound(movement(without_radius(b), without_radius(some_b)));
  return {(of_bound(s.low) - reach).inf(), (of_bound(s.high) + reach).sup()};
}

IntervalVector in_the_middle(IntervalVector x) {
  for (Interval& c : x) c = Interval(CGAL::to_double(c));
  return x;
}
/// A core with vertices near those of an input in the middle of the others. That of a box has edges that are
/// perpendicular but for rounding.
IntervalCore in_the_middle(const IntervalCore& core) {
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
Interval distance_of_all(const Q<Interval>& q, const IntervalCore& a, const IntervalCore& b,
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
    if (!all_finite(n) || !all_finite(p1_) || !all_finite(p2_)) return 0;
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

  const IntervalCore &a_, &b_;
  const Interval distance_;
  const NumberVector<GivenVector> normals_;
  const GivenVector p1_, p2_;
  const IntervalVector at1_, at2_;
  Proofs proofs_;
};

/// Where two lines along edges of the cores are nearest: the point of the first one. Empty where the intervals cannot
/// tell.
std::optional<IntervalVector> nearest_on_first(const IntervalVector& at1, const IntervalVector& along1,
                                               const IntervalVector& at2, const IntervalVector& along2) {
  const IntervalVector across = cross(along1, along2);
  const Interval length2 = norm2(across);
  if (!(length2.inf() > 0)) return std::nullopt;
  const Interval t = dot(cross(minus(at2, at1), along2), across) / length2;
  return plus(at1, times(along1, t));
}

/// Narrows a point of the core to those that are nearest to a point, by a segment's equation. The point is nearest to
/// it where the cores are apart.
IntervalVector nearest_to(const IntervalVector& to, const IntervalCore& core, IntervalVector point) {
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
bool is_difference_flat(const IntervalCore& a, const IntervalCore& b) {
  const auto dimensions = [](const IntervalCore& core) { return core.vertices.size() - 1; };
  return dimensions(a) + dimensions(b) <= 2;
}

/// Encloses the normal by the boxes that the points of the way lie in.
IntervalVector normal_between(const IntervalVector& from, const IntervalVector& to, const Interval& distance,
                              const IntervalVector& normal) {
  if (!(distance.inf() > 0)) return normal;
  IntervalVector between = times(minus(to, from), Interval(Interval(1) / distance));
  for (Interval& x : between) x = assume_within(x, -1.0, 1.0);
  return within_both(normal, between);
}

/// Encloses the right normals of cores at this distance from each other. With points of both at the ends of `way`, each
/// right normal n has n . way >= distance: it lies in a cone around the way.
IntervalVector normals_around(const IntervalVector& way, const Interval& distance) {
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
IntervalVector normals_of(const IntervalCore& a, const IntervalCore& b, const Interval& distance) {
  const Interval any(-1, 1);
  if (!(distance.inf() > 0)) return {any, any, any};
  const NearPoints near(a, b);
  if (!near.weights()) return {any, any, any};
  const auto& [of_a, of_b] = *near.weights();
  return normals_around(minus(point_at(spans_of(b), of_b), point_at(spans_of(a), of_a)), distance);
}

/// From a half-space. Where several vertices may be the deepest one, each answer lies between them, at its heights.
template <template <class> class Q, class Out>
  requires WithHalfSpace<Q, Interval>
void signed_distance_of(const Q<Interval>& q, Out& out) {
  const IntervalCore a = core_of(q.a);
  const IntervalVector outward = vector(q.b.normal), normal = unit_of(negated(outward));
  const Interval norm = root(norm2(outward));
  if (!(norm.inf() > 0)) return out.everything();
  const Interval level = projection(outward, a).low, s = (level + q.b.offset) / norm;
  const MayBeFurthest may_be{a, normal};
  const IntervalVector c1 = hull_of(a, may_be), c2 = plus(c1, times(normal, s));
  IntervalCore without_radius;
  const auto answer = signed_distance_answer(a, without_radius, s, normal, c1, c2);
  if (std::count_if(a.vertices.begin(), a.vertices.end(), may_be) <= 1) return out.yes(answer);
  const GivenVector p1 = out.given_vector(point1_at).front(), p2 = out.given_vector(point2_at).front();
  const IntervalVector origin{Interval(0), Interval(0), Interval(0)};
  const double of1 = least_ulps(p1, {outward, origin, level - a.radius * norm});
  const double of2 = least_ulps(p2, {outward, origin, -q.b.offset});
  out.yes(answer,
          SetDistance{{{point1_at, {of1, HUGE_VAL}}, {point2_at, {of2, HUGE_VAL}}}, {std::max(of1, of2), HUGE_VAL}});
}

template <template <class> class Q, class Out>
void signed_distance_of(const Q<Interval>& q, Out& out) {
  IntervalCore a = core_of(q.a), b = core_of(q.b);
  const IntervalVector place = place_near(a);
  a = relative_to(place, std::move(a)), b = relative_to(place, std::move(b));
  const bool has_no_volume = is_difference_flat(a, b);
  const double apart = least_distance(a, b);
  const Interval distance = meet(Interval(has_no_volume || apart > 0 ? apart : -HUGE_VAL, HUGE_VAL),
                                 distance_of_all<Q>(q, a, b, out.middle()));
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

}  // namespace

#define NEARMISS_SIGNED_DISTANCE(first, second)                                                               \
  template <class N, class Out>                                                                               \
  void first##_##second##_signed_distance(const inputs::first##_##second##_signed_distance<N>& q, Out& out) { \
    signed_distance_of(q, out);                                                                               \
  }                                                                                                           \
  template <class N>                                                                                          \
  bool on_surface(const inputs::first##_##second##_signed_distance<N>& q, const GivenPlace<N>& place) {       \
    return place.number == point1_at ? may_be_on_surface_of(q.a, place) : may_be_on_surface_of(q.b, place);   \
  }                                                                                                           \
  NEARMISS_ORACLE(first##_##second##_signed_distance)
#include "impl/catalogue/grid.def"

}  // namespace nearmiss::oracle
