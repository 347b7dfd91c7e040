/// slide_direction in the tiers of the library collide::certified.
#include <collide/slide_direction.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Direction<T> slide_direction(const Sphere<T>& sphere, const Vec3<T>& velocity, T time, const Vec3<T>& location) {
  return kernels::slide_direction<InStages<Tier>>(sphere, velocity, time, location);
}

template Direction<float> slide_direction<Certified>(const Sphere<float>&, const Vec3<float>&, float,
                                                     const Vec3<float>&);
template Direction<double> slide_direction<Certified>(const Sphere<double>&, const Vec3<double>&, double,
                                                      const Vec3<double>&);

}  // namespace collide::compiled
