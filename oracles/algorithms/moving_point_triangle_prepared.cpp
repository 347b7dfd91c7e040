/// Truth: that of the plain triangle. Precomputed inputs never change an answer.
#include "impl/catalogue/queries/moving_point_triangle_prepared.hpp"

#include "oracles/algorithms/front_of_triangle.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_point_triangle_prepared(const inputs::moving_point_triangle_prepared<N>& q, Out& out) {
  const auto& t = q.triangle;
  report(front_hit<N>(vector(q.point), vector(q.velocity), {vector(t.v0), vector(t.v1), vector(t.v2)}), out);
}

template <class N>
bool on_surface(const inputs::moving_point_triangle_prepared<N>& q, const GivenPlace<N>& place) {
  return may_be_on_triangle(place, q.triangle);
}

NEARMISS_ORACLE(moving_point_triangle_prepared)

}  // namespace nearmiss::oracle
