/// Truth: the intersection of the times between the three pairs of face planes.
#include "impl/catalogue/queries/moving_point_span_aabox.hpp"

#include "oracles/algorithms/spans.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_point_span_aabox(const inputs::moving_point_span_aabox<N>& q, Out& out) {
  report_span(times_in_box(vector(q.point), vector(q.velocity), vector(q.aabox.min), vector(q.aabox.max)), out);
}

NEARMISS_ORACLE(moving_point_span_aabox)

}  // namespace nearmiss::oracle
