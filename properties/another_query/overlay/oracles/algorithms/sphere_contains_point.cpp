/// Truth: the sign of |p - c|^2 - r^2.
#include "impl/catalogue/queries/sphere_contains_point.hpp"

#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void sphere_contains_point(const inputs::sphere_contains_point<N>& q, Out& out) {
  const N outside = norm2(minus(vector(q.point), vector(q.sphere.center))) - square(q.sphere.radius);
  if (may_be_positive(outside)) out.no();
  if (may_be_at_most_zero(outside)) out.yes({true});
}

NEARMISS_ORACLE(sphere_contains_point)

}  // namespace nearmiss::oracle
