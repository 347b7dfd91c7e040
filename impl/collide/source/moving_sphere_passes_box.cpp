/// moving_sphere_passes_box in the tiers of the library collide::certified.
#include <collide/moving_sphere_passes_box.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Decision<T> moving_sphere_passes_box(const Sphere<T>& sphere, const Vec3<T>& velocity, const Box<T>& box, T limit) {
  return kernels::moving_sphere_passes_box<InStages<Tier>>(sphere, velocity, box, limit);
}

template Decision<float> moving_sphere_passes_box<Certified>(const Sphere<float>&, const Vec3<float>&,
                                                             const Box<float>&, float);
template Decision<double> moving_sphere_passes_box<Certified>(const Sphere<double>&, const Vec3<double>&,
                                                              const Box<double>&, double);

}  // namespace collide::compiled
