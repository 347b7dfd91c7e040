/// Truth: separating axes decide; each face through which the ray may enter gives a location.
#include "impl/catalogue/queries/ray_aabox.hpp"

#include "oracles/algorithms/ray_and_box.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void ray_aabox(const inputs::ray_aabox<N>& q, Out& out) {
  using RayHit = collide::RayHit<N>;
  const RayAndBox<N> r{vector(q.ray.origin), vector(q.ray.direction), vector(q.aabox.min), vector(q.aabox.max)};
  if (may_start_in(r)) out.yes(RayHit{q.ray.origin, true, true});
  if (may_miss(r)) out.no(RayHit{}, 1);
  for_each_entry(r, [&](const N&, const Vector<N>& place) { out.yes(RayHit{answer_vector(place), true, false}); });
}

/// A ray that starts in the box meets the box at its start.
template <class N>
bool on_surface(const inputs::ray_aabox<N>& q, const GivenPlace<N>& place) {
  return may_be_on_aabox(place, q.aabox) || may_be_point(place, vector(q.ray.origin));
}

NEARMISS_ORACLE(ray_aabox)

}  // namespace nearmiss::oracle
