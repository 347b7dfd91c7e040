/// moving_sphere_plane in the tiers of the library collide::certified.
#include <collide/moving_sphere_plane.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Impact<T> moving_sphere_plane(const Sphere<T>& sphere, const Vec3<T>& velocity, const Plane<T>& plane) {
  return kernels::moving_sphere_plane<InStages<Tier>>(sphere, velocity, plane);
}

template Impact<float> moving_sphere_plane<Certified>(const Sphere<float>&, const Vec3<float>&, const Plane<float>&);
template Impact<double> moving_sphere_plane<Certified>(const Sphere<double>&, const Vec3<double>&,
                                                       const Plane<double>&);
template Impact<float> moving_sphere_plane<Decisive>(const Sphere<float>&, const Vec3<float>&, const Plane<float>&);
template Impact<double> moving_sphere_plane<Decisive>(const Sphere<double>&, const Vec3<double>&, const Plane<double>&);

}  // namespace collide::compiled
