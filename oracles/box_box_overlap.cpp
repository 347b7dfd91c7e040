/// Truth: the fifteen separating axes over exact rotations; a cross product that is zero is no axis. Where
/// the boxes are apart, each axis that strictly separates them is right.
#include <collide/box_box_overlap.hpp>

#include "oracles/two_boxes.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void box_box_overlap(const collide::inputs::box_box_overlap<N>& q, Out& out) {
  const TwoBoxes<N> boxes(q.box1, q.box2);
  bool surely = false;
  for (int k = 0; k < collide::box_box_axes; ++k) {
    const N gap = boxes.gap(k);
    if (may_be_positive(gap)) out.no({false, k}, 1);
    surely = surely || !may_be_at_most_zero(gap);
  }
  if (!surely) out.yes({true, -1});
}

NEARMISS_ORACLE(box_box_overlap, BoxOverlap)

}  // namespace nearmiss::oracle
