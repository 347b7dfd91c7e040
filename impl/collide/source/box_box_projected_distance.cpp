/// box_box_projected_distance in the tiers of the library collide::certified.
#include <collide/box_box_projected_distance.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Measure<T> box_box_projected_distance(const Box<T>& box1, const Box<T>& box2, int axis) {
  return kernels::box_box_projected_distance<InStages<Tier>>(box1, box2, axis);
}

template <class Tier, class T>
Measure<T> box_box_projected_distance(const BoxBoxInfo<T>& info, int axis) {
  return kernels::box_box_projected_distance<InStages<Tier>>(info, axis);
}

template Measure<float> box_box_projected_distance<Certified>(const Box<float>&, const Box<float>&, int);
template Measure<double> box_box_projected_distance<Certified>(const Box<double>&, const Box<double>&, int);
template Measure<float> box_box_projected_distance<Certified>(const BoxBoxInfo<float>&, int);
template Measure<double> box_box_projected_distance<Certified>(const BoxBoxInfo<double>&, int);

}  // namespace collide::compiled
