/// moving_point_box in the tiers of the library collide::certified.
#include <collide/moving_point_box.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Impact<T> moving_point_box(const Vec3<T>& point, const Vec3<T>& velocity, const Box<T>& box) {
  return kernels::moving_point_box<InStages<Tier>>(point, velocity, box);
}

template Impact<float> moving_point_box<Certified>(const Vec3<float>&, const Vec3<float>&, const Box<float>&);
template Impact<double> moving_point_box<Certified>(const Vec3<double>&, const Vec3<double>&, const Box<double>&);

}  // namespace collide::compiled
