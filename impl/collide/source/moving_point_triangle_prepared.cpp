/// moving_point_triangle_prepared in the tiers of the library collide::certified.
#include <collide/moving_point_triangle_prepared.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Impact<T> moving_point_triangle_prepared(const Vec3<T>& point, const Vec3<T>& velocity,
                                         const PreparedTriangle<T>& prepared) {
  return kernels::moving_point_triangle_prepared<InStages<Tier>>(point, velocity, prepared);
}

template Impact<float> moving_point_triangle_prepared<Certified>(const Vec3<float>&, const Vec3<float>&,
                                                                 const PreparedTriangle<float>&);
template Impact<double> moving_point_triangle_prepared<Certified>(const Vec3<double>&, const Vec3<double>&,
                                                                  const PreparedTriangle<double>&);
template Impact<float> moving_point_triangle_prepared<Decisive>(const Vec3<float>&, const Vec3<float>&,
                                                                const PreparedTriangle<float>&);
template Impact<double> moving_point_triangle_prepared<Decisive>(const Vec3<double>&, const Vec3<double>&,
                                                                 const PreparedTriangle<double>&);

}  // namespace collide::compiled
