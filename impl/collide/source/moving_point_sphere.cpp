/// moving_point_sphere in the tiers of the library collide::certified.
#include <collide/moving_point_sphere.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Impact<T> moving_point_sphere(const Vec3<T>& point, const Vec3<T>& velocity, const Sphere<T>& sphere, bool solid) {
  return kernels::moving_point_sphere<InStages<Tier>>(point, velocity, sphere, solid);
}

template Impact<float> moving_point_sphere<Certified>(const Vec3<float>&, const Vec3<float>&, const Sphere<float>&,
                                                      bool);
template Impact<double> moving_point_sphere<Certified>(const Vec3<double>&, const Vec3<double>&, const Sphere<double>&,
                                                       bool);

}  // namespace collide::compiled
