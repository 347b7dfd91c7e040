/// Truth: the quadratic of the distance between the centers.
#include "impl/catalogue/queries/moving_sphere_sphere.hpp"

#include "oracles/algorithms/moving_sphere_and_capsule.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_sphere_sphere(const inputs::moving_sphere_sphere<N>& q, Out& out) {
  const Vector<N> center = vector(q.fixed.center);
  report_first_contact<N>(
      {vector(q.sphere.center), vector(q.velocity), q.sphere.radius, {center, center}, q.fixed.radius, true}, out);
}

template <class N>
bool on_surface(const inputs::moving_sphere_sphere<N>& q, const GivenPlace<N>& place) {
  return may_be_on_sphere(place, q.fixed);
}

NEARMISS_ORACLE(moving_sphere_sphere)

}  // namespace nearmiss::oracle
