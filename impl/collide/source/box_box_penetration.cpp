/// box_box_penetration in the tiers of the library collide::certified.
#include <collide/box_box_penetration.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
BoxPenetration<T> box_box_penetration(const Box<T>& box1, const Box<T>& box2, int hint) {
  return kernels::box_box_penetration<InStages<Tier>>(box1, box2, hint);
}

template BoxPenetration<float> box_box_penetration<Certified>(const Box<float>&, const Box<float>&, int);
template BoxPenetration<double> box_box_penetration<Certified>(const Box<double>&, const Box<double>&, int);
template BoxPenetration<float> box_box_penetration<Decisive>(const Box<float>&, const Box<float>&, int);
template BoxPenetration<double> box_box_penetration<Decisive>(const Box<double>&, const Box<double>&, int);

}  // namespace collide::compiled
