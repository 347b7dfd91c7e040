/// Truth: the sign of |c2 - c1|^2 - (r1 + r2)^2.
#include "impl/catalogue/queries/sphere_sphere_overlap.hpp"

#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void sphere_sphere_overlap(const inputs::sphere_sphere_overlap<N>& q, Out& out) {
  const N apart =
      norm2(minus(vector(q.sphere1.center), vector(q.sphere2.center))) - square(N(q.sphere1.radius + q.sphere2.radius));
  if (may_be_positive(apart)) out.no();
  if (may_be_at_most_zero(apart)) out.yes({true});
}

NEARMISS_ORACLE(sphere_sphere_overlap)

}  // namespace nearmiss::oracle
