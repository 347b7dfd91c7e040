/// Truth of the grid's signed distances. That from a half-space is measured against its normal. The signed distance of
/// two cores is the greatest gap between them over all directions of length 1, and each right normal has that gap.
/// Where the cores are apart, or meet in a volume, it is one of the directions of any_direction(). Where they only
/// touch or cross without a volume, each direction that separates them weakly is right: those of a cone, or both
/// normals of a face that is common to them. With a normal n the nearest points c1 and c2 of the cores are any points
/// of theirs with c2 - c1 = gap n, so c1 lies in the common part of a feature of the first and of the moved one of the
/// second: a polygon, or less. The radii move the points along n.
#include <algorithm>

#include "impl/catalogue/queries/grid.hpp"
#include "oracles/algorithms/surface_of_shapes.hpp"
#include "oracles/algorithms/two_cores.hpp"

namespace nearmiss::oracle {

namespace {

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
void signed_distance_of(const Q<Exact>& q, Out& out) {
  const ExactCore a = in_units(core_of(q.a)), b = in_units(core_of(q.b));
  report_tuples(a, b, greatest_gaps(a, b), out);
}
template <template <class> class Q, class Out>
void signed_distance_of(const Q<Interval>& q, Out& out) {
  IntervalCore a = core_of(q.a), b = core_of(q.b);
  const IntervalVector place = place_near(a);
  a = relative_to(place, std::move(a)), b = relative_to(place, std::move(b));
  report_tuples(a, b, place, enclosed_distance<Q>(q, a, b, out.middle()), out);
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
