/// Truth: the fifteen separating axes over exact rotations; a cross product that is zero is no axis.
#include <collide/box_box_overlap.hpp>

#include "oracles/outcomes.hpp"

namespace nearmiss::oracle {

namespace {

/// Half the length of the box's shadow on `axis`, times |axis|.
template <class N>
N reach(const std::array<Vector<N>, 3>& axes, const Vector<N>& half, const Vector<N>& axis) {
  return half[0] * magnitude(inner(axes[0], axis)) + half[1] * magnitude(inner(axes[1], axis)) +
         half[2] * magnitude(inner(axes[2], axis));
}

}  // namespace

template <class N, class Out>
void box_box_overlap(const collide::inputs::box_box_overlap<N>& q, Out& out) {
  const auto axes1 = rotation_axes<N>(q.box1.orientation), axes2 = rotation_axes<N>(q.box2.orientation);
  const Vector<N> half1 = vector(q.box1.half), half2 = vector(q.box2.half);
  const Vector<N> between = minus(vector(q.box2.center), vector(q.box1.center));
  bool may_separate = false;
  const auto separated = [&](const Vector<N>& axis) {
    const N gap = magnitude(inner(between, axis)) - reach(axes1, half1, axis) - reach(axes2, half2, axis);
    may_separate = may_separate || may_be_positive(gap);
    return !may_be_at_most_zero(gap);
  };
  bool surely = false;
  for (int i = 0; i < 3 && !surely; ++i) surely = separated(axes1[i]) || separated(axes2[i]);
  for (int i = 0; i < 9 && !surely; ++i) surely = separated(outer(axes1[i / 3], axes2[i % 3]));
  if (may_separate) out.no();
  if (!surely) out.yes({true});
}

NEARMISS_ORACLE(box_box_overlap, Decision)

}  // namespace nearmiss::oracle
