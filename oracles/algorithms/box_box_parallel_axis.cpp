/// Truth: the first pair of axes that may reach the cosine while every pair before it may fail to. For nearly parallel
/// unit vectors a, b the comparison uses |a -+ b|^2 = 2 (1 -+ cosine), which is tight where the cosine is not.
#include "impl/catalogue/queries/box_box_parallel_axis.hpp"

#include "oracles/algorithms/two_boxes.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void box_box_parallel_axis(const inputs::box_box_parallel_axis<N>& q, Out& out) {
  const TwoBoxes<N> boxes(q.box1, q.box2);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const N cosine = magnitude(boxes.cosine(i, j));
      const N beyond = meet(N(cosine - (N(1) - q.epsilon)), N(q.epsilon - (N(1) - cosine)));
      const N same = q.epsilon - norm2(minus(boxes.axes1[i], boxes.axes2[j])) / N(2);
      const N opposite = q.epsilon - norm2(plus(boxes.axes1[i], boxes.axes2[j])) / N(2);
      const bool may = may_be_at_least_zero(beyond) && (may_be_at_least_zero(same) || may_be_at_least_zero(opposite));
      const bool may_not =
          may_be_negative(beyond) && may_be_negative(same) && may_be_negative(opposite) && may_be_less(q.epsilon, N(1));
      if (may) out.yes({true, i, j});
      if (!may_not) return;
    }
  }
  out.no();
}

NEARMISS_ORACLE(box_box_parallel_axis)

}  // namespace nearmiss::oracle
