/// box_box_info in the tiers of the library collide::certified.
#include <collide/box_box_info.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
BoxBoxInfo<T> box_box_info(const Box<T>& box1, const Box<T>& box2) {
  return kernels::box_box_info<InStages<Tier>>(box1, box2);
}

template BoxBoxInfo<float> box_box_info<Certified>(const Box<float>&, const Box<float>&);
template BoxBoxInfo<double> box_box_info<Certified>(const Box<double>&, const Box<double>&);

}  // namespace collide::compiled
