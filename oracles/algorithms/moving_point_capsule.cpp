/// Truth: the first contact of a ball of radius 0 with the tube or with one of the balls at its ends.
#include "impl/catalogue/queries/moving_point_capsule.hpp"

#include "oracles/algorithms/moving_sphere_and_capsule.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_point_capsule(const inputs::moving_point_capsule<N>& q, Out& out) {
  const auto& c = q.capsule;
  report_first_contact<N>({vector(q.point), vector(q.velocity), N(0), {vector(c.p0), vector(c.p1)}, c.radius, false},
                          out);
}

template <class N>
bool on_surface(const inputs::moving_point_capsule<N>& q, const GivenPlace<N>& place) {
  return may_be_on_capsule(place, q.capsule);
}

NEARMISS_ORACLE(moving_point_capsule)

}  // namespace nearmiss::oracle
