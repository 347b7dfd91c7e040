/// sphere_triangle_overlap in the tiers of the library collide::certified.
#include <collide/sphere_triangle_overlap.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Decision<T> sphere_triangle_overlap(const Sphere<T>& sphere, const Triangle<T>& triangle) {
  return kernels::sphere_triangle_overlap<InStages<Tier>>(sphere, triangle);
}

template Decision<float> sphere_triangle_overlap<Certified>(const Sphere<float>&, const Triangle<float>&);
template Decision<double> sphere_triangle_overlap<Certified>(const Sphere<double>&, const Triangle<double>&);

}  // namespace collide::compiled
