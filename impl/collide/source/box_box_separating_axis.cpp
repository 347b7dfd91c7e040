/// box_box_separating_axis in the tiers of the library collide::certified.
#include <collide/box_box_separating_axis.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Direction<T> box_box_separating_axis(const Box<T>& box1, const Box<T>& box2, int axis) {
  return kernels::box_box_separating_axis<InStages<Tier>>(box1, box2, axis);
}

template Direction<float> box_box_separating_axis<Certified>(const Box<float>&, const Box<float>&, int);
template Direction<double> box_box_separating_axis<Certified>(const Box<double>&, const Box<double>&, int);

}  // namespace collide::compiled
