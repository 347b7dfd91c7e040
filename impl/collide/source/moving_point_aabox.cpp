/// moving_point_aabox in the tiers of the library collide::certified.
#include <collide/moving_point_aabox.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Entry<T> moving_point_aabox(const Vec3<T>& point, const Vec3<T>& velocity, const AABox<T>& aabox) {
  return kernels::moving_point_aabox<InStages<Tier>>(point, velocity, aabox);
}

template Entry<float> moving_point_aabox<Certified>(const Vec3<float>&, const Vec3<float>&, const AABox<float>&);
template Entry<double> moving_point_aabox<Certified>(const Vec3<double>&, const Vec3<double>&, const AABox<double>&);
template Entry<float> moving_point_aabox<Decisive>(const Vec3<float>&, const Vec3<float>&, const AABox<float>&);
template Entry<double> moving_point_aabox<Decisive>(const Vec3<double>&, const Vec3<double>&, const AABox<double>&);

}  // namespace collide::compiled
