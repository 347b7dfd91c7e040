/// Truth: the largest |v - c|^2 - r^2 of a vertex v is not positive. The ball is convex.
#include "impl/catalogue/queries/sphere_contains_polyline.hpp"

#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void sphere_contains_polyline(const inputs::sphere_contains_polyline<N>& q, Out& out) {
  bool may_be_outside = false, may_be_inside = true;
  for (const auto& vertex : q.polyline.vertices) {
    const N outside = norm2(minus(vector(vertex), vector(q.sphere.center))) - square(q.sphere.radius);
    may_be_outside = may_be_outside || may_be_positive(outside);
    may_be_inside = may_be_inside && may_be_at_most_zero(outside);
  }
  if (may_be_outside) out.no();
  if (may_be_inside) out.yes({true});
}

NEARMISS_ORACLE(sphere_contains_polyline)

}  // namespace nearmiss::oracle
