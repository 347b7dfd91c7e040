/// sphere_box_overlap in the tiers of the library collide::certified.
#include <collide/sphere_box_overlap.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Decision<T> sphere_box_overlap(const Sphere<T>& sphere, const Box<T>& box) {
  return kernels::sphere_box_overlap<InStages<Tier>>(sphere, box);
}

template Decision<float> sphere_box_overlap<Certified>(const Sphere<float>&, const Box<float>&);
template Decision<double> sphere_box_overlap<Certified>(const Sphere<double>&, const Box<double>&);

}  // namespace collide::compiled
