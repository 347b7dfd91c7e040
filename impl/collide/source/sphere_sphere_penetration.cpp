/// sphere_sphere_penetration in the tiers of the library collide::certified.
#include <collide/sphere_sphere_penetration.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Penetration<T> sphere_sphere_penetration(const Sphere<T>& sphere1, const Sphere<T>& sphere2) {
  return kernels::sphere_sphere_penetration<InStages<Tier>>(sphere1, sphere2);
}

template Penetration<float> sphere_sphere_penetration<Certified>(const Sphere<float>&, const Sphere<float>&);
template Penetration<double> sphere_sphere_penetration<Certified>(const Sphere<double>&, const Sphere<double>&);
template Penetration<float> sphere_sphere_penetration<Decisive>(const Sphere<float>&, const Sphere<float>&);
template Penetration<double> sphere_sphere_penetration<Decisive>(const Sphere<double>&, const Sphere<double>&);

}  // namespace collide::compiled
