/// sphere_plane_penetration in the tiers of the library collide::certified.
#include <collide/sphere_plane_penetration.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Penetration<T> sphere_plane_penetration(const Sphere<T>& sphere, const Plane<T>& plane) {
  return kernels::sphere_plane_penetration<InStages<Tier>>(sphere, plane);
}

template Penetration<float> sphere_plane_penetration<Certified>(const Sphere<float>&, const Plane<float>&);
template Penetration<double> sphere_plane_penetration<Certified>(const Sphere<double>&, const Plane<double>&);
template Penetration<float> sphere_plane_penetration<Decisive>(const Sphere<float>&, const Plane<float>&);
template Penetration<double> sphere_plane_penetration<Decisive>(const Sphere<double>&, const Plane<double>&);

}  // namespace collide::compiled
