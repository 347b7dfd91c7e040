/// bounce_direction in the tiers of the library collide::certified.
#include <collide/bounce_direction.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Direction<T> bounce_direction(const Sphere<T>& sphere, const Vec3<T>& velocity, T time, const Vec3<T>& location,
                              const Vec3<T>& normal) {
  return kernels::bounce_direction<InStages<Tier>>(sphere, velocity, time, location, normal);
}

template Direction<float> bounce_direction<Certified>(const Sphere<float>&, const Vec3<float>&, float,
                                                      const Vec3<float>&, const Vec3<float>&);
template Direction<double> bounce_direction<Certified>(const Sphere<double>&, const Vec3<double>&, double,
                                                       const Vec3<double>&, const Vec3<double>&);

}  // namespace collide::compiled
