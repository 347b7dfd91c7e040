/// Truth: the center's height above the plane, scaled by the normal's length, is linear in time.
#include "impl/catalogue/queries/moving_sphere_plane.hpp"

#include "oracles/algorithms/surface.hpp"
#include "oracles/algorithms/times.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_sphere_plane(const inputs::moving_sphere_plane<N>& q, Out& out) {
  const Vector<N> c = vector(q.sphere.center), v = vector(q.velocity), n = vector(q.plane.normal);
  const N radius = q.sphere.radius;
  const N approach = -dot(n, v);                // >= 0: not away from the front
  const N height = dot(n, c) + q.plane.offset;  // times |n|
  const N length2 = norm2(n);
  if (may_be_zero(length2)) return out.everything();
  const N length = root(length2), reach = radius * length;
  if (may_be_negative(approach) || may_be_less(height, N(-reach))) out.no();
  if (!may_be_at_least_zero(approach) || !may_be_at_most(N(-reach), height)) return;
  const Vector<N> normal = times(n, N(N(1) / length));
  if (may_be_at_most(height, reach)) {
    const Vector<N> foot = minus(c, times(n, N(height / length2)));
    out.yes({N(0), answer_vector(foot), answer_vector(normal)});
    // As a set the plane has two sides; here the center is behind it.
    if (may_be_at_most_zero(height)) out.yes({N(0), answer_vector(foot), answer_vector(negated(normal))});
  }
  if (!may_be_less(reach, height)) return;
  if (may_be_at_most_zero(approach)) out.no();
  if (!may_be_positive(approach)) return;
  if (may_be_zero(approach)) return out.everything();
  const N time = time_across(N(height - reach), approach);
  const Vector<N> location = minus(plus(c, times(v, time)), times(n, N(radius / length)));
  out.yes({time, answer_vector(location), answer_vector(normal)});
}

template <class N>
bool on_surface(const inputs::moving_sphere_plane<N>& q, const GivenPlace<N>& place) {
  return may_be_on_plane(place, q.plane);
}

NEARMISS_ORACLE(moving_sphere_plane)

}  // namespace nearmiss::oracle
