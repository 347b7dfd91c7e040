/// Truth: |D| <= |a| + |b| squared, which leaves one root: |D|^2 - |a|^2 - |b|^2 <= 2 |a| |b|.
#include "impl/catalogue/queries/box_box_conservative.hpp"

#include "oracles/exact/answer_sink.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void box_box_conservative(const inputs::box_box_conservative<N>& q, Out& out) {
  const N a2 = norm2(vector(q.box1.half)), b2 = norm2(vector(q.box2.half));
  const N d2 = norm2(minus(vector(q.box2.center), vector(q.box1.center)));
  const N beyond = d2 - a2 - b2 - N(2) * root(N(a2 * b2));
  if (may_be_positive(beyond)) out.no();
  if (may_be_at_most_zero(beyond)) out.yes({true});
}

NEARMISS_ORACLE(box_box_conservative)

}  // namespace nearmiss::oracle
