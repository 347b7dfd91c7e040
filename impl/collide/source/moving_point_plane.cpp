/// moving_point_plane in the tiers of the library collide::certified.
#include <collide/moving_point_plane.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Impact<T> moving_point_plane(const Vec3<T>& point, const Vec3<T>& velocity, const Plane<T>& plane) {
  return kernels::moving_point_plane<InStages<Tier>>(point, velocity, plane);
}

template Impact<float> moving_point_plane<Certified>(const Vec3<float>&, const Vec3<float>&, const Plane<float>&);
template Impact<double> moving_point_plane<Certified>(const Vec3<double>&, const Vec3<double>&, const Plane<double>&);
template Impact<float> moving_point_plane<Decisive>(const Vec3<float>&, const Vec3<float>&, const Plane<float>&);
template Impact<double> moving_point_plane<Decisive>(const Vec3<double>&, const Vec3<double>&, const Plane<double>&);

}  // namespace collide::compiled
