/// box_box_conservative in the tiers of the library collide::certified.
#include <collide/box_box_conservative.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Decision<T> box_box_conservative(const Box<T>& box1, const Box<T>& box2) {
  return kernels::box_box_conservative<InStages<Tier>>(box1, box2);
}

template <class Tier, class T>
Decision<T> box_box_conservative(const BoxBoxInfo<T>& info) {
  return kernels::box_box_conservative<InStages<Tier>>(info);
}

template Decision<float> box_box_conservative<Certified>(const Box<float>&, const Box<float>&);
template Decision<double> box_box_conservative<Certified>(const Box<double>&, const Box<double>&);
template Decision<float> box_box_conservative<Certified>(const BoxBoxInfo<float>&);
template Decision<double> box_box_conservative<Certified>(const BoxBoxInfo<double>&);

}  // namespace collide::compiled
