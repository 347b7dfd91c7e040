/// Truth: in the box's frame, the intersection of the times between the three pairs of face planes.
#include "impl/catalogue/queries/moving_point_span_box.hpp"

#include "oracles/algorithms/spans.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_point_span_box(const inputs::moving_point_span_box<N>& q, Out& out) {
  const auto axes = rotation_axes<N>(q.box.orientation);
  const Vector<N> half = vector(q.box.half), at = into(axes, minus(vector(q.point), vector(q.box.center)));
  report_span(times_in_box(at, into(axes, vector(q.velocity)), negated(half), half), out);
}

NEARMISS_ORACLE(moving_point_span_box)

}  // namespace nearmiss::oracle
