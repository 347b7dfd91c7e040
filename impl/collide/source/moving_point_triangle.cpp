/// moving_point_triangle in the tiers of the library collide::certified.
#include <collide/moving_point_triangle.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Impact<T> moving_point_triangle(const Vec3<T>& point, const Vec3<T>& velocity, const Triangle<T>& triangle) {
  return kernels::moving_point_triangle<InStages<Tier>>(point, velocity, triangle);
}

template Impact<float> moving_point_triangle<Certified>(const Vec3<float>&, const Vec3<float>&, const Triangle<float>&);
template Impact<double> moving_point_triangle<Certified>(const Vec3<double>&, const Vec3<double>&,
                                                         const Triangle<double>&);
template Impact<float> moving_point_triangle<Decisive>(const Vec3<float>&, const Vec3<float>&, const Triangle<float>&);
template Impact<double> moving_point_triangle<Decisive>(const Vec3<double>&, const Vec3<double>&,
                                                        const Triangle<double>&);

}  // namespace collide::compiled
