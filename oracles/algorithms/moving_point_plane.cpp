/// Truth: the height above the plane is linear in time.
#include "impl/catalogue/queries/moving_point_plane.hpp"

#include "oracles/algorithms/surface.hpp"
#include "oracles/algorithms/times.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_point_plane(const inputs::moving_point_plane<N>& q, Out& out) {
  const Vector<N> p = vector(q.point), v = vector(q.velocity), n = vector(q.plane.normal);
  const N approach = -dot(n, v);                // > 0: toward the front
  const N height = dot(n, p) + q.plane.offset;  // >= 0: starts in front
  if (may_be_at_most_zero(approach) || may_be_negative(height)) out.no();
  if (!may_be_positive(approach) || !may_be_at_least_zero(height)) return;
  const N length2 = norm2(n);
  if (may_be_zero(approach) || may_be_zero(length2)) return out.everything();
  const N time = time_across(height, approach);
  out.yes({time, answer_vector(plus(p, times(v, time))), answer_vector(times(n, N(N(1) / root(length2))))});
}

template <class N>
bool on_surface(const inputs::moving_point_plane<N>& q, const GivenPlace<N>& place) {
  return may_be_on_plane(place, q.plane);
}

NEARMISS_ORACLE(moving_point_plane)

}  // namespace nearmiss::oracle
