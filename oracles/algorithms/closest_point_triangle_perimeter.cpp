/// Truth: the least squared distance from the edges; on each edge the sign of the distance's derivative at both ends
/// decides.
#include "impl/catalogue/queries/closest_point_triangle_perimeter.hpp"

#include "oracles/algorithms/nearest_piece.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void closest_point_triangle_perimeter(const inputs::closest_point_triangle_perimeter<N>& q, Out& out) {
  const std::array<Vector<N>, 3> corner{vector(q.triangle.v0), vector(q.triangle.v1), vector(q.triangle.v2)};
  for_each_nearest(perimeter(corner, vector(q.point)),
                   [&](std::size_t, const Place<N>& place) { out.yes({answer_vector(place.point)}); });
}

template <class N>
bool on_surface(const inputs::closest_point_triangle_perimeter<N>& q, const GivenPlace<N>& place) {
  const auto& t = q.triangle;
  return may_be_on_perimeter<N, 3>(place, {vector(t.v0), vector(t.v1), vector(t.v2)});
}

NEARMISS_ORACLE(closest_point_triangle_perimeter)

}  // namespace nearmiss::oracle
