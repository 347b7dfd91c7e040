/// Truth: that of closest_point_segment. Precomputed inputs never change the answer.
#include "impl/catalogue/queries/closest_point_segment_unit.hpp"

#include "oracles/algorithms/nearest_piece.hpp"
#include "oracles/algorithms/surface.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void closest_point_segment_unit(const inputs::closest_point_segment_unit<N>& q, Out& out) {
  const std::array<Vector<N>, 2> ends{vector(q.segment.v0), vector(q.segment.v1)};
  for (const Place<N>& place : edge_piece(ends, 0, 1, vector(q.point)).places) out.yes({answer_vector(place.point)});
}

template <class N>
bool on_surface(const inputs::closest_point_segment_unit<N>& q, const GivenPlace<N>& place) {
  return may_be_on_segment(place, q.segment);
}

NEARMISS_ORACLE(closest_point_segment_unit)

}  // namespace nearmiss::oracle
