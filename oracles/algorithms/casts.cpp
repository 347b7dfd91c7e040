/// Truth of the grid's casts. The height of a deepest vertex of the moving core above the plane of a half-space is
/// linear in time, and the same vertices stay the deepest ones. Any point between them may be met first.
#include <algorithm>

#include "impl/catalogue/queries/grid.hpp"
#include "oracles/algorithms/furthest.hpp"
#include "oracles/algorithms/near_points.hpp"
#include "oracles/algorithms/rounded_polytopes.hpp"
#include "oracles/algorithms/surface_of_shapes.hpp"
#include "oracles/algorithms/times.hpp"

namespace nearmiss::oracle {

namespace {

constexpr std::size_t location_at = begin_of<collide::Impact<double>>("location");

/// The deepest vertices of a core, and a half-space with a normal of length 1.
template <class N>
struct AboveHalfSpace;

template <>
struct AboveHalfSpace<Exact> {
  ExactVector normal;
  Exact height;
  std::vector<ExactVector> deepest;  ///< the corners of a polygon

  template <class HalfSpace>
  AboveHalfSpace(const ExactCore& core, const HalfSpace& halfspace, const Exact& norm)
      : deepest(furthest(core, negated(vector(halfspace.normal)))) {
    const Exact inverse = Exact(norm / square(norm));  // whose root is that of the norm
    normal = times(vector(halfspace.normal), inverse);
    height = Exact(dot(vector(halfspace.normal), deepest.front()) + halfspace.offset) * inverse;
  }

  /// Contacts at that time and at the deepest vertices, moved by `way`.
  template <class Out>
  void report(const Exact& time, const ExactVector& way, Out& out) const {
    const auto answer = [&](const ExactVector& vertex) {
      return collide::Impact<Exact>{time, answer_vector(plus(vertex, way)), answer_vector(normal)};
    };
    for (const ExactVector& vertex : deepest) out.yes(answer(vertex));
    if (deepest.size() == 1 || !out.compares_yes()) return;
    std::vector<RationalVector> polygon;
    for (const ExactVector& vertex : deepest) polygon.push_back(rational(vertex));
    const NearestPoint nearest = nearest_in_polygon({offset_place(out, location_at, way)}, polygon);
    const RationalVector& x = nearest.member ? *nearest.member : polygon.front();
    out.yes(answer({Exact(x[0]), Exact(x[1]), Exact(x[2])}), SetDistance{{{location_at, nearest.ulps}}, nearest.ulps});
  }
};

template <>
struct AboveHalfSpace<Interval> {
  IntervalVector outward, normal;
  Interval offset, height;
  IntervalVector deepest;  ///< a box around the vertices
  bool is_one = false;     ///< the same vertex for all inputs

  template <class HalfSpace>
  AboveHalfSpace(const IntervalCore& core, const HalfSpace& halfspace, const Interval& norm)
      : outward(vector(halfspace.normal)), normal(unit_of(outward)), offset(halfspace.offset) {
    height = (projection(outward, core).low + offset) / norm;
    const IntervalVector down = negated(normal);
    const MayBeFurthest may_be{core, down};
    deepest = hull_of(core, may_be);
    is_one = std::count_if(core.vertices.begin(), core.vertices.end(), may_be) <= 1;
  }

  /// Where several vertices may be the deepest one, each contact lies between them, on the plane.
  template <class Out>
  void report(const Interval& time, const IntervalVector& way, Out& out) const {
    const collide::Impact<Interval> answer{time, answer_vector(plus(deepest, way)), answer_vector(normal)};
    if (is_one) return out.yes(answer);
    const IntervalVector origin{Interval(0), Interval(0), Interval(0)};
    const double off = least_ulps(out.given_vector(location_at).front(), {outward, origin, -offset});
    out.yes(answer, SetDistance{{{location_at, {off, HUGE_VAL}}}, {off, HUGE_VAL}});
  }
};

template <template <class> class Q, class N, class Out>
void cast_of(const Q<N>& q, Out& out) {
  Core<N> a = core_of(q.a);
  if constexpr (!is_enclosure<N>) a = in_units(a);
  const Vector<N> velocity = vector(q.velocity), outward = vector(q.b.normal);
  const N length2 = norm2(outward);
  if (may_be_zero(length2)) return out.everything();
  const N norm = root(length2);
  const AboveHalfSpace<N> above(a, q.b, norm);
  const N gap = above.height - a.radius, approach = -dot(outward, velocity);
  const bool may_touch = may_be_zero(gap);
  if (may_be_negative(gap) || (may_touch && may_be_at_least_zero(approach)))
    above.report(N(0), times(above.normal, N(-above.height)), out);
  if ((may_be_positive(gap) && may_be_at_most_zero(approach)) || (may_touch && may_be_negative(approach))) out.no();
  if (!may_be_positive(gap) || !may_be_positive(approach)) return;
  if (may_be_zero(approach)) return out.everything();
  const N time = time_across(N(gap * norm), approach);
  above.report(time, minus(times(velocity, time), times(above.normal, a.radius)), out);
}

}  // namespace

#define NEARMISS_CAST_AS(query, first, second)                             \
  template <class N, class Out>                                            \
  void query(const inputs::query<N>& q, Out& out) {                        \
    cast_of(q, out);                                                       \
  }                                                                        \
  template <class N>                                                       \
  bool on_surface(const inputs::query<N>& q, const GivenPlace<N>& place) { \
    return may_be_on_surface_of(q.b, place);                               \
  }                                                                        \
  NEARMISS_ORACLE(query)
#include "impl/catalogue/grid.def"

}  // namespace nearmiss::oracle
