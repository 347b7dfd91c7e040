/// Truth: the fifteen separating axes over exact rotations. A zero cross product is no axis. If the boxes are apart,
/// each axis that strictly separates them is right.
#include "impl/catalogue/queries/box_box_overlap.hpp"

#include <optional>

#include "oracles/algorithms/two_boxes.hpp"

namespace nearmiss::oracle {

namespace {

/// For cross products of edges that may be parallel: whether the boxes overlap along every direction perpendicular to
/// both edges.
template <class N>
class Parallels {
 public:
  explicit Parallels(const TwoBoxes<N>& boxes) : boxes_(boxes) {}

  bool surely_overlap_across(int k) {
    if constexpr (is_enclosure<N>) {
      if (k < 6) return false;
      if (!axes_) {
        axes_.emplace();
        for (int other = 0; other < inputs::box_box_axes; ++other) (*axes_)[other] = PairAxis<N>(boxes_, other);
      }
      return least_depth_across(boxes_, *axes_, k) >= 0;
    } else {
      return false;
    }
  }

 private:
  const TwoBoxes<N>& boxes_;
  std::optional<PairAxes> axes_;
};

}  // namespace

template <class N, class Out>
void box_box_overlap(const inputs::box_box_overlap<N>& q, Out& out) {
  const TwoBoxes<N> boxes(q.box1, q.box2);
  Parallels<N> parallels(boxes);
  bool surely = false;
  for (int k = 0; k < inputs::box_box_axes; ++k) {
    const N gap = boxes.gap(k);
    const bool must_separate = !may_be_at_most_zero(gap);
    surely = surely || must_separate;
    if (may_be_positive(gap) && (must_separate || !parallels.surely_overlap_across(k))) out.no({false, k}, 1);
  }
  if (!surely) out.yes({true, -1});
}

NEARMISS_ORACLE(box_box_overlap)

}  // namespace nearmiss::oracle
