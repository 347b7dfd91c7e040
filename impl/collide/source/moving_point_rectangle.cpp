/// moving_point_rectangle in the tiers of the library collide::certified.
#include <collide/moving_point_rectangle.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Impact<T> moving_point_rectangle(const Vec3<T>& point, const Vec3<T>& velocity, const Rectangle<T>& rectangle) {
  return kernels::moving_point_rectangle<InStages<Tier>>(point, velocity, rectangle);
}

template Impact<float> moving_point_rectangle<Certified>(const Vec3<float>&, const Vec3<float>&,
                                                         const Rectangle<float>&);
template Impact<double> moving_point_rectangle<Certified>(const Vec3<double>&, const Vec3<double>&,
                                                          const Rectangle<double>&);

}  // namespace collide::compiled
