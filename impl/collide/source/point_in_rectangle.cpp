/// point_in_rectangle in the tiers of the library collide::certified.
#include <collide/point_in_rectangle.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Decision<T> point_in_rectangle(const Rectangle<T>& rectangle, const Vec3<T>& normal, const Vec3<T>& point) {
  return kernels::point_in_rectangle<InStages<Tier>>(rectangle, normal, point);
}

template Decision<float> point_in_rectangle<Certified>(const Rectangle<float>&, const Vec3<float>&, const Vec3<float>&);
template Decision<double> point_in_rectangle<Certified>(const Rectangle<double>&, const Vec3<double>&,
                                                        const Vec3<double>&);

}  // namespace collide::compiled
