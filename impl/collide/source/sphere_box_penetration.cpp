/// sphere_box_penetration in the tiers of the library collide::certified.
#include <collide/sphere_box_penetration.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Penetration<T> sphere_box_penetration(const Sphere<T>& sphere, const Box<T>& box) {
  return kernels::sphere_box_penetration<InStages<Tier>>(sphere, box);
}

template Penetration<float> sphere_box_penetration<Certified>(const Sphere<float>&, const Box<float>&);
template Penetration<double> sphere_box_penetration<Certified>(const Sphere<double>&, const Box<double>&);
template Penetration<float> sphere_box_penetration<Decisive>(const Sphere<float>&, const Box<float>&);
template Penetration<double> sphere_box_penetration<Decisive>(const Sphere<double>&, const Box<double>&);

}  // namespace collide::compiled
