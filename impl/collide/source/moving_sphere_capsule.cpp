/// moving_sphere_capsule in the tiers of the library collide::certified.
#include <collide/moving_sphere_capsule.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Impact<T> moving_sphere_capsule(const Sphere<T>& sphere, const Vec3<T>& velocity, const Capsule<T>& capsule) {
  return kernels::moving_sphere_capsule<InStages<Tier>>(sphere, velocity, capsule);
}

template Impact<float> moving_sphere_capsule<Certified>(const Sphere<float>&, const Vec3<float>&,
                                                        const Capsule<float>&);
template Impact<double> moving_sphere_capsule<Certified>(const Sphere<double>&, const Vec3<double>&,
                                                         const Capsule<double>&);

}  // namespace collide::compiled
