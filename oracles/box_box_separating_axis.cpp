/// Truth: the axis in the world, by the rotations' matrices.
#include <collide/box_box_separating_axis.hpp>

#include "oracles/two_boxes.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void box_box_separating_axis(const collide::inputs::box_box_separating_axis<N>& q, Out& out) {
  out.yes({answer_vector(TwoBoxes<N>(q.box1, q.box2).axis(q.axis))});
}

NEARMISS_ORACLE(box_box_separating_axis, Direction)

}  // namespace nearmiss::oracle
