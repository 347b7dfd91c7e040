/// Sets of right answers whose numbers depend on each other: a normal and its place, the points of a patch. An oracle
/// names the set, and the given answer is compared with the nearest member. Shared by the oracles of queries with such
/// sets.
#pragma once

#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

/// With each of the normals n the place base + reach n is right. `normal` and `place` are the indices of their first
/// numbers in the answer.
template <class N>
struct NormalWithPlace {
  Normals<N> normals;
  Vector<N> base;
  N reach;
  std::size_t normal, place;
};

/// The nearest of the given normal's forms, with normal and place compared together.
inline NearestNormal nearest_together(const NumberVector<GivenVector>& normal, const Cone& cone,
                                      const NormalOffset& lever) {
  NearestNormal nearest = nearest_normal(normal.front(), cone, lever);
  for (std::size_t i = 1; i < normal.size() && nearest.ulps.low > 0; ++i) {
    const NearestNormal other = nearest_normal(normal[i], cone, lever);
    const Bounds ulps = nearer(nearest.ulps, other.ulps);
    if (other.ulps.high < nearest.ulps.high) nearest.member = other.member;
    nearest.ulps = ulps;
  }
  return nearest;
}

/// Reports the whole set; make(normal, place) builds the answer.
template <class Out, class Make>
void yes_to_any(const NormalWithPlace<Exact>& set, Out& out, Make make) {
  const Cone cone = cone_of(set.normals);
  const auto answer = [&](const Vector<Exact>& normal) {
    return make(normal, plus(set.base, times(normal, set.reach)));
  };
  const Vector<Exact> of_cone;
  if (surely_zero(set.reach)) return out.yes(make(of_cone, set.base), set.normals);
  if (!out.compares_yes()) return out.yes(answer(some_normal(cone)), set.normals);
  const NumberVector<GivenVector> normal = out.given_vector(set.normal);
  const NormalOffset lever{out.given_vector(set.place).front(), rational(set.base), rational(set.reach)};
  const NearestNormal both = nearest_together(normal, cone, lever);
  SetDistance from{{{set.normal, {0, both.ulps.high}}, {set.place, {0, both.ulps.high}}}, both.ulps};
  if (both.ulps.low > 0) {  // alone each may be right
    GivenVector nothing;
    nothing.scalar = normal.front().scalar;
    from.vectors[0].ulps = ulps_from(normal, set.normals);
    from.vectors[1].ulps = nearest_normal(nothing, cone, lever).ulps;
  }
  out.yes(answer(both.member ? *both.member : some_normal(cone)), from);
}

template <class Out, class Make>
void yes_to_any(const NormalWithPlace<Interval>& set, Out& out, Make make) {
  const Interval any(-1, 1);
  const Vector<Interval> normal{any, any, any};
  if (surely_zero(set.reach)) return out.yes(make(normal, set.base), set.normals);
  const NumberVector<GivenVector> given = out.given_vector(set.normal);
  const GivenVector place = out.given_vector(set.place).front();
  double both = HUGE_VAL;
  for (const GivenVector& g : given) both = std::min(both, least_ulps_together(g, place, set.base, set.reach));
  out.yes(make(normal, plus(set.base, times(normal, set.reach))),
          SetDistance{{{set.normal, ulps_from(given, set.normals)},
                       {set.place, {least_ulps(place, set.base, set.reach), HUGE_VAL}}},
                      {both, HUGE_VAL}});
}

/// Reports that every point of a convex polygon is right; `point` is the index of its first number in the answer.
template <class Out, class Make>
void yes_to_any_of(const std::vector<Vector<Exact>>& corners, std::size_t point, Out& out, Make make) {
  for (const Vector<Exact>& corner : corners) out.yes(make(corner));
  if (corners.size() == 1 || !out.compares_yes()) return;
  std::vector<RationalVector> polygon;
  for (const Vector<Exact>& corner : corners) polygon.push_back(rational(corner));
  const NearestPoint nearest = nearest_in_polygon(out.given_vector(point).front(), polygon);
  const RationalVector& x = nearest.member ? *nearest.member : polygon.front();
  out.yes(make(Vector<Exact>{Exact(x[0]), Exact(x[1]), Exact(x[2])}),
          SetDistance{{{point, nearest.ulps}}, nearest.ulps});
}
/// A lower bound of the given point's distance from every point that satisfies all forms, in ulps.
template <class Out>
Bounds ulps_from(const NumberVector<Form>& forms, std::size_t point, const Out& out) {
  double least = 0;
  for (const Form& form : forms) least = std::max(least, least_ulps(out.given_vector(point).front(), form));
  return {least, HUGE_VAL};
}
/// Reports that every point that satisfies all forms is right; `a` encloses their answers.
template <class Out, class A>
void yes_to_all_on(const NumberVector<Form>& forms, std::size_t point, Out& out, const A& a) {
  const Bounds ulps = ulps_from(forms, point, out);
  out.yes(a, SetDistance{{{point, ulps}}, ulps});
}

}  // namespace nearmiss::oracle
