/// moving_sphere_rectangle in the tiers of the library collide::certified.
#include <collide/moving_sphere_rectangle.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Impact<T> moving_sphere_rectangle(const Sphere<T>& sphere, const Vec3<T>& velocity, const Rectangle<T>& rectangle) {
  return kernels::moving_sphere_rectangle<InStages<Tier>>(sphere, velocity, rectangle);
}

template Impact<float> moving_sphere_rectangle<Certified>(const Sphere<float>&, const Vec3<float>&,
                                                          const Rectangle<float>&);
template Impact<double> moving_sphere_rectangle<Certified>(const Sphere<double>&, const Vec3<double>&,
                                                           const Rectangle<double>&);

}  // namespace collide::compiled
