/// ray_aabox in the tiers of the library collide::certified.
#include <collide/ray_aabox.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
RayHit<T> ray_aabox(const PreparedRay<T>& ray, const PreparedAABox<T>& box) {
  return kernels::ray_aabox<InStages<Tier>>(ray, box);
}

template RayHit<float> ray_aabox<Certified>(const PreparedRay<float>&, const PreparedAABox<float>&);
template RayHit<double> ray_aabox<Certified>(const PreparedRay<double>&, const PreparedAABox<double>&);
template RayHit<float> ray_aabox<Decisive>(const PreparedRay<float>&, const PreparedAABox<float>&);
template RayHit<double> ray_aabox<Decisive>(const PreparedRay<double>&, const PreparedAABox<double>&);

}  // namespace collide::compiled
