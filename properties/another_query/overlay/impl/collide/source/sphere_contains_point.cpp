/// sphere_contains_point in the tiers of the library collide::certified.
#include <collide/sphere_contains_point.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Decision<T> sphere_contains_point(const Sphere<T>& sphere, const Vec3<T>& point) {
  return kernels::sphere_contains_point<InStages<Tier>>(sphere, point);
}

template Decision<float> sphere_contains_point<Certified>(const Sphere<float>&, const Vec3<float>&);
template Decision<double> sphere_contains_point<Certified>(const Sphere<double>&, const Vec3<double>&);

}  // namespace collide::compiled
