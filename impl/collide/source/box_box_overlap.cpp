/// box_box_overlap in the tiers of the library collide::certified.
#include <collide/box_box_overlap.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
BoxOverlap<T> box_box_overlap(const Box<T>& box1, const Box<T>& box2, int hint) {
  return kernels::box_box_overlap<InStages<Tier>>(box1, box2, hint);
}

template BoxOverlap<float> box_box_overlap<Certified>(const Box<float>&, const Box<float>&, int);
template BoxOverlap<double> box_box_overlap<Certified>(const Box<double>&, const Box<double>&, int);

}  // namespace collide::compiled
