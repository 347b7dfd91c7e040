/// moving_sphere_sphere in the tiers of the library collide::certified.
#include <collide/moving_sphere_sphere.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Impact<T> moving_sphere_sphere(const Sphere<T>& sphere, const Vec3<T>& velocity, const Sphere<T>& fixed) {
  return kernels::moving_sphere_sphere<InStages<Tier>>(sphere, velocity, fixed);
}

template Impact<float> moving_sphere_sphere<Certified>(const Sphere<float>&, const Vec3<float>&, const Sphere<float>&);
template Impact<double> moving_sphere_sphere<Certified>(const Sphere<double>&, const Vec3<double>&,
                                                        const Sphere<double>&);

}  // namespace collide::compiled
