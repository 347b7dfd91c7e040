/// Truth of the grid's overlaps: two rounded polytopes are apart if a direction separates their cores by more than the
/// sum of their radii. If there is one, then the direction of the shortest way between the cores is one, and that joins
/// two features: it is the normal of a face, the cross product of two edges, perpendicular to an edge, or between two
/// vertices. The bodies meet if none of these separates. From a half-space only its normal separates.
#include "impl/catalogue/queries/grid.hpp"
#include "oracles/algorithms/rounded_polytopes.hpp"

namespace nearmiss::oracle {

namespace {

/// Which decisions are possible.
struct Decisions {
  bool may_be_apart = false, may_meet = true;
};

/// By the directions that separate.
template <class N>
Decisions by_directions(const Core<N>& a, const Core<N>& b) {
  const N radius2 = square(N(a.radius + b.radius));
  Decisions d;
  d.may_meet = !any_direction(a, b, (a.has_volume || b.has_volume) && surely_zero(radius2),
                              [&](const Vector<N>& n, TwoEdges<N>) {
                                for (const N& gap : gaps(n, a, b)) {
                                  if (!may_be_positive(gap)) continue;
                                  const N beyond = square(assume_at_least_zero(gap)) - radius2 * norm2(n);
                                  if (!may_be_positive(beyond)) continue;
                                  d.may_be_apart = true;
                                  if (!may_be_at_most_zero(gap) && !may_be_at_most_zero(beyond)) return true;
                                }
                                return false;
                              });
  return d;
}

/// By the signed distance for the inputs in the middle: where each vertex moves by at most so much, and each radius,
/// the signed distance changes by at most as much.
template <template <class> class Q>
Decisions by_distance(const Q<Interval>& q, std::span<const double> inputs) {
  const std::vector<double> middle = without_tiny_numbers<Q<double>>(inputs);
  const auto point = inputs_at<Q<Interval>>(middle);
  const Core<Interval> a = core_of(point.a), b = core_of(point.b);
  const Vector<Interval> place = place_near(a);
  std::optional<Bounds> s = signed_distance(relative_to(place, a), relative_to(place, b));
  if (!s) s = exact_signed_distance<Q>(middle);
  const Interval reach = of_bound(movement(core_of(q.a), a)) + of_bound(movement(core_of(q.b), b));
  const Interval radii = a.radius + b.radius;
  return {!((of_bound(s->high) - radii + reach).sup() <= 0), !((of_bound(s->low) - radii - reach).inf() > 0)};
}

template <template <class> class Q, class N>
concept WithHalfSpace = std::same_as<decltype(Q<N>::b), collide::HalfSpace<N>>;

/// Whether the lowest vertex of the core is at most the radius above the half-space's plane.
template <class N, template <class> class Q, class Out>
  requires WithHalfSpace<Q, N>
void overlap(const Q<N>& q, Out& out) {
  const Core<N> a = core_of(q.a);
  const Vector<N> normal = vector(q.b.normal);
  const N height = projection(normal, a).low + a.unit * q.b.offset;
  if (!may_be_positive(height)) return out.yes({true});
  const N beyond = square(assume_at_least_zero(height)) - square(N(a.radius * a.unit)) * norm2(normal);
  if (may_be_positive(beyond)) out.no();
  if (may_be_at_most_zero(height) || may_be_at_most_zero(beyond)) out.yes({true});
}

template <class N, template <class> class Q, class Out>
void overlap(const Q<N>& q, Out& out) {
  Core<N> a = core_of(q.a), b = core_of(q.b);
  if constexpr (!is_enclosure<N>) {
    const N of_a = a.unit, of_b = b.unit;
    a = times(of_b, std::move(a));
    b = times(of_a, std::move(b));
  }
  const Vector<N> place = place_near(a);
  Decisions d = by_directions(relative_to(place, a), relative_to(place, b));
  if constexpr (is_enclosure<N>) {
    if (d.may_be_apart && d.may_meet && !out.middle().empty()) {
      const Decisions by = by_distance(q, out.middle());
      d = {d.may_be_apart && by.may_be_apart, d.may_meet && by.may_meet};
    }
  }
  if (d.may_be_apart) out.no();
  if (d.may_meet) out.yes({true});
}

}  // namespace

#define NEARMISS_OVERLAP(first, second)                                                       \
  template <class N, class Out>                                                               \
  void first##_##second##_overlap(const inputs::first##_##second##_overlap<N>& q, Out& out) { \
    overlap(q, out);                                                                          \
  }                                                                                           \
  NEARMISS_ORACLE(first##_##second##_overlap)
#include "impl/catalogue/grid.def"

}  // namespace nearmiss::oracle
