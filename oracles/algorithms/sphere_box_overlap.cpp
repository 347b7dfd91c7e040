/// Truth: the squared distance from the feature of each region around the box in which the center may lie.
#include "impl/catalogue/queries/sphere_box_overlap.hpp"

#include "oracles/algorithms/point_and_box.hpp"

namespace nearmiss::oracle {

template <class N, class Out>
void sphere_box_overlap(const inputs::sphere_box_overlap<N>& q, Out& out) {
  const Vector<N> half = vector(q.box.half);
  const Vector<N> local =
      into(rotation_axes<N>(q.box.orientation), minus(vector(q.sphere.center), vector(q.box.center)));
  bool may_meet = true;  // may the center be inside?
  for (int i = 0; i < 3; ++i) may_meet = may_meet && may_be_on_side(local[i], half[i], 0);
  bool may_be_apart = false;
  for_each_possible_region(local, half, [&](const Sides& sides) {
    const N outside = from_feature(local, half, sides).distance2 - square(q.sphere.radius);
    may_meet = may_meet || may_be_at_most_zero(outside);
    may_be_apart = may_be_apart || may_be_positive(outside);
  });
  if (may_be_apart) out.no();
  if (may_meet) out.yes({true});
}

NEARMISS_ORACLE(sphere_box_overlap)

}  // namespace nearmiss::oracle
