/// Truth: the times in the balls at both ends and in the tube between them, whose union is convex.
#include "impl/catalogue/queries/moving_point_span_capsule.hpp"

#include "oracles/algorithms/moving_sphere_and_capsule.hpp"
#include "oracles/algorithms/spans.hpp"

namespace nearmiss::oracle {

namespace {

/// The times in the tube between two ends, of which the second is at `d` from the first. `from` is the vector from the
/// first end to the point. All squares of distances from the axis are multiplied by length2, that of `d`.
template <class N>
Times<N> times_in_tube(const Vector<N>& from, const Vector<N>& step, const Vector<N>& d, const N& length2,
                       const N& radius) {
  const Vector<N> from_d = cross(from, d), step_d = cross(step, d);
  const N a = norm2(step_d), reach2 = square(radius);
  const Times<N> beside = times_within_roots(a, N(-dot(from_d, step_d)), N(norm2(from_d) - reach2 * length2),
                                             N(length2 * (a * reach2 - square(dot(d, cross(from, step))))));
  Times<N> times = both(beside, times_between(N(dot(d, from)), N(dot(d, step)), N(0), length2));
  if constexpr (is_enclosure<N>) {  // the tube lies in a ball about an end; tightens only short tubes
    const bool may_be_none = times.may_be_none;
    times = both(times, times_in_ball(from, step, N(radius + root(length2))));
    if (times.may_be_some) times.may_be_none = may_be_none;
  }
  return times;
}

}  // namespace

template <class N, class Out>
void moving_point_span_capsule(const inputs::moving_point_span_capsule<N>& q, Out& out) {
  const Vector<N> step = vector(q.velocity), from[2] = {minus(vector(q.point), vector(q.capsule.p0)),
                                                        minus(vector(q.point), vector(q.capsule.p1))};
  const N radius = q.capsule.radius;
  Times<N> times = either(times_in_ball(from[0], step, radius), times_in_ball(from[1], step, radius));
  const Vector<N> d = minus(vector(q.capsule.p1), vector(q.capsule.p0));
  if (const N length2 = norm2(d); may_be_positive(length2))
    times = either(times, times_in_tube(from[0], step, d, length2, radius));
  if constexpr (is_enclosure<N>) {
    const SphereAndCapsule<N> m{vector(q.point), step, N(0), {vector(q.capsule.p0), vector(q.capsule.p1)},
                                radius,          false};
    if (times.may_be_none && CapsuleContacts<N>{m}.surely_reaches_somewhere()) times.may_be_none = false;
  }
  report_span(times, out);
}

NEARMISS_ORACLE(moving_point_span_capsule)

}  // namespace nearmiss::oracle
