/// Truth: the projections of both boxes on the given axis, in the world frame.
#include "impl/catalogue/queries/box_box_projected_distance.hpp"

#include "oracles/algorithms/two_boxes.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void box_box_projected_distance(const inputs::box_box_projected_distance<N>& q, Out& out) {
  out.yes({TwoBoxes<N>(q.box1, q.box2).gap(q.axis)});
}

NEARMISS_ORACLE(box_box_projected_distance)

}  // namespace nearmiss::oracle
