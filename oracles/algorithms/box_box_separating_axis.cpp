/// Truth: the axis in the world frame, by the rotation matrices.
#include "impl/catalogue/queries/box_box_separating_axis.hpp"

#include "oracles/algorithms/two_boxes.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void box_box_separating_axis(const inputs::box_box_separating_axis<N>& q, Out& out) {
  out.yes({answer_vector(TwoBoxes<N>(q.box1, q.box2).axis(q.axis))});
}

NEARMISS_ORACLE(box_box_separating_axis)

}  // namespace nearmiss::oracle
