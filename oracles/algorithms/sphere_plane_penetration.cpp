/// Truth: the signed distance of the center, one root.
#include "impl/catalogue/queries/sphere_plane_penetration.hpp"

#include "oracles/algorithms/surface.hpp"
#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void sphere_plane_penetration(const inputs::sphere_plane_penetration<N>& q, Out& out) {
  const Vector<N> n = vector(q.plane.normal), center = vector(q.sphere.center);
  const N norm_squared = norm2(n);
  if (may_be_zero(norm_squared)) return out.everything();
  const N per_norm = N(1) / root(norm_squared);
  collide::Penetration<N> a{q.sphere.radius - (dot(n, center) + q.plane.offset) * per_norm, {}, {}};
  if (may_be_negative(a.depth)) out.no(a, 1);
  if (!may_be_at_least_zero(a.depth)) return;
  Vector<N> normal = times(n, per_norm);
  for (N& x : normal) x = assume_within(x, -1.0, 1.0);
  a.normal = answer_vector(normal);
  a.contact = answer_vector(minus(center, times(normal, q.sphere.radius)));
  out.yes(a);
}

template <class N>
bool on_surface(const inputs::sphere_plane_penetration<N>& q, const GivenPlace<N>& place) {
  return may_be_on_sphere(place, q.sphere);
}

NEARMISS_ORACLE(sphere_plane_penetration)

}  // namespace nearmiss::oracle
