/// moving_point_capsule in the tiers of the library collide::certified.
#include <collide/moving_point_capsule.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Impact<T> moving_point_capsule(const Vec3<T>& point, const Vec3<T>& velocity, const Capsule<T>& capsule) {
  return kernels::moving_point_capsule<InStages<Tier>>(point, velocity, capsule);
}

template Impact<float> moving_point_capsule<Certified>(const Vec3<float>&, const Vec3<float>&, const Capsule<float>&);
template Impact<double> moving_point_capsule<Certified>(const Vec3<double>&, const Vec3<double>&,
                                                        const Capsule<double>&);

}  // namespace collide::compiled
