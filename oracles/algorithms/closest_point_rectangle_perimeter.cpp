/// Truth: the least squared distance from the edges; on each edge the sign of the distance's derivative at both ends
/// decides.
#include "impl/catalogue/queries/closest_point_rectangle_perimeter.hpp"

#include "oracles/algorithms/nearest_piece.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void closest_point_rectangle_perimeter(const inputs::closest_point_rectangle_perimeter<N>& q, Out& out) {
  const auto& r = q.rectangle;
  const std::array<Vector<N>, 4> corner{vector(r.v0), vector(r.v1), vector(r.v2), vector(r.v3)};
  for_each_nearest(perimeter(corner, vector(q.point)),
                   [&](std::size_t, const Place<N>& place) { out.yes({answer_vector(place.point)}); });
}

template <class N>
bool on_surface(const inputs::closest_point_rectangle_perimeter<N>& q, const GivenPlace<N>& place) {
  const auto& r = q.rectangle;
  return may_be_on_perimeter<N, 4>(place, {vector(r.v0), vector(r.v1), vector(r.v2), vector(r.v3)});
}

NEARMISS_ORACLE(closest_point_rectangle_perimeter)

}  // namespace nearmiss::oracle
