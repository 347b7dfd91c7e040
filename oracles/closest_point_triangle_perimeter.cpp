/// Truth: each edge by the sign of the distance's derivative at its ends; the least squared distance.
#include <collide/closest_point_triangle_perimeter.hpp>

#include "oracles/nearest_piece.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void closest_point_triangle_perimeter(const collide::inputs::closest_point_triangle_perimeter<N>& q, Out& out) {
  const std::array<Vector<N>, 3> corner{vector(q.triangle.v0), vector(q.triangle.v1), vector(q.triangle.v2)};
  for_each_nearest(perimeter(corner, vector(q.point)), [&](std::size_t, const Place<N>& place) {
    out.yes({answer_vector(place.point)});
  });
}

NEARMISS_ORACLE(closest_point_triangle_perimeter, ClosestPoint)

}  // namespace nearmiss::oracle
