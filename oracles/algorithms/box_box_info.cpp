/// Truth: the definitions of the numbers, over exact rotations.
#include "impl/catalogue/queries/box_box_info.hpp"

#include "oracles/algorithms/two_boxes.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void box_box_info(const inputs::box_box_info<N>& q, Out& out) {
  const TwoBoxes<N> boxes(q.box1, q.box2);
  collide::BoxBoxInfo<N> info;
  info.half1 = q.box1.half;
  info.half2 = q.box2.half;
  info.between = answer_vector(boxes.between);
  for (int i = 0; i < 3; ++i) {
    const Vector<N> row{boxes.cosine(i, 0), boxes.cosine(i, 1), boxes.cosine(i, 2)};
    info.cosine[i] = answer_vector(row);
    info.abs_cosine[i] = {magnitude(row[0]), magnitude(row[1]), magnitude(row[2])};
  }
  info.between1 = answer_vector(into(boxes.axes1, boxes.between));
  info.between2 = answer_vector(into(boxes.axes2, boxes.between));
  out.yes(info);
}

NEARMISS_ORACLE(box_box_info)

}  // namespace nearmiss::oracle
