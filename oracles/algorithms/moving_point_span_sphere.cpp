/// Truth: the roots of the quadratic |p + v t - c|^2 = r^2, its discriminant by Lagrange's identity.
#include "impl/catalogue/queries/moving_point_span_sphere.hpp"

#include "oracles/algorithms/spans.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_point_span_sphere(const inputs::moving_point_span_sphere<N>& q, Out& out) {
  const Vector<N> from = minus(vector(q.point), vector(q.sphere.center));
  report_span(times_in_ball(from, vector(q.velocity), q.sphere.radius), out);
}

NEARMISS_ORACLE(moving_point_span_sphere)

}  // namespace nearmiss::oracle
