/// Truth: the earlier hit of two triangles.
#include "impl/catalogue/queries/moving_point_rectangle.hpp"

#include "oracles/algorithms/front_of_triangle.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_point_rectangle(const inputs::moving_point_rectangle<N>& q, Out& out) {
  const Vector<N> p = vector(q.point), v = vector(q.velocity);
  const Vector<N> v0 = vector(q.rectangle.v0), v2 = vector(q.rectangle.v2);
  const FrontHit<N> hits[2] = {front_hit<N>(p, v, {v0, vector(q.rectangle.v1), v2}),
                               front_hit<N>(p, v, {v0, v2, vector(q.rectangle.v3)})};
  if (hits[0].may_miss && hits[1].may_miss) out.no();
  for (int i = 0; i < 2; ++i) {
    const FrontHit<N>&hit = hits[i], &other = hits[1 - i];
    const bool surely_later = hit.may_hit && !other.may_miss && !may_be_at_most(hit.impact.time, other.impact.time);
    if (hit.may_hit && !surely_later) out.yes(hit.impact, hit.normals);
  }
}

template <class N>
bool on_surface(const inputs::moving_point_rectangle<N>& q, const GivenPlace<N>& place) {
  return may_be_on_rectangle(place, q.rectangle);
}

NEARMISS_ORACLE(moving_point_rectangle)

}  // namespace nearmiss::oracle
