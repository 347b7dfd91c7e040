/// moving_sphere_triangle in the tiers of the library collide::certified.
#include <collide/moving_sphere_triangle.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
TriangleImpact<T> moving_sphere_triangle(const Sphere<T>& sphere, const Vec3<T>& velocity,
                                         const Triangle<T>& triangle) {
  return kernels::moving_sphere_triangle<InStages<Tier>>(sphere, velocity, triangle);
}

template TriangleImpact<float> moving_sphere_triangle<Certified>(const Sphere<float>&, const Vec3<float>&,
                                                                 const Triangle<float>&);
template TriangleImpact<double> moving_sphere_triangle<Certified>(const Sphere<double>&, const Vec3<double>&,
                                                                  const Triangle<double>&);

}  // namespace collide::compiled
