/// moving_sphere_passes_sphere in the tiers of the library collide::certified.
#include <collide/moving_sphere_passes_sphere.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Decision<T> moving_sphere_passes_sphere(const Sphere<T>& sphere, const Vec3<T>& velocity, const Sphere<T>& fixed,
                                        const T& limit) {
  return kernels::moving_sphere_passes_sphere<InStages<Tier>>(sphere, velocity, fixed, limit);
}

template Decision<float> moving_sphere_passes_sphere<Certified>(const Sphere<float>&, const Vec3<float>&,
                                                                const Sphere<float>&, const float&);
template Decision<double> moving_sphere_passes_sphere<Certified>(const Sphere<double>&, const Vec3<double>&,
                                                                 const Sphere<double>&, const double&);

}  // namespace collide::compiled
