/// sphere_sphere_overlap in the tiers of the library collide::certified.
#include <collide/sphere_sphere_overlap.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Decision<T> sphere_sphere_overlap(const Sphere<T>& sphere1, const Sphere<T>& sphere2) {
  return kernels::sphere_sphere_overlap<InStages<Tier>>(sphere1, sphere2);
}

template Decision<float> sphere_sphere_overlap<Certified>(const Sphere<float>&, const Sphere<float>&);
template Decision<double> sphere_sphere_overlap<Certified>(const Sphere<double>&, const Sphere<double>&);

}  // namespace collide::compiled
