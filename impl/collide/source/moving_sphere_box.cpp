/// moving_sphere_box in the tiers of the library collide::certified.
#include <collide/moving_sphere_box.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Impact<T> moving_sphere_box(const Sphere<T>& sphere, const Vec3<T>& velocity, const Box<T>& box) {
  return kernels::moving_sphere_box<InStages<Tier>>(sphere, velocity, box);
}

template Impact<float> moving_sphere_box<Certified>(const Sphere<float>&, const Vec3<float>&, const Box<float>&);
template Impact<double> moving_sphere_box<Certified>(const Sphere<double>&, const Vec3<double>&, const Box<double>&);

}  // namespace collide::compiled
