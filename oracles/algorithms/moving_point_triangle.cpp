/// Truth: the plane's linear equation, then the signed distances of the hit point from each edge in the plane.
#include "impl/catalogue/queries/moving_point_triangle.hpp"

#include "oracles/algorithms/front_of_triangle.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void moving_point_triangle(const inputs::moving_point_triangle<N>& q, Out& out) {
  const auto& t = q.triangle;
  report(front_hit<N>(vector(q.point), vector(q.velocity), {vector(t.v0), vector(t.v1), vector(t.v2)}), out);
}

template <class N>
bool on_surface(const inputs::moving_point_triangle<N>& q, const GivenPlace<N>& place) {
  return may_be_on_triangle(place, q.triangle);
}

NEARMISS_ORACLE(moving_point_triangle)

}  // namespace nearmiss::oracle
