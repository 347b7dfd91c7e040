/// Truth: the first contact with the tube or one of the balls at its ends.
#include "impl/catalogue/queries/moving_sphere_capsule.hpp"

#include "oracles/algorithms/moving_sphere_and_capsule.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_sphere_capsule(const inputs::moving_sphere_capsule<N>& q, Out& out) {
  const auto& c = q.capsule;
  report_first_contact<N>(
      {vector(q.sphere.center), vector(q.velocity), q.sphere.radius, {vector(c.p0), vector(c.p1)}, c.radius, false},
      out);
}

template <class N>
bool on_surface(const inputs::moving_sphere_capsule<N>& q, const GivenPlace<N>& place) {
  return may_be_on_capsule(place, q.capsule);
}

NEARMISS_ORACLE(moving_sphere_capsule)

}  // namespace nearmiss::oracle
