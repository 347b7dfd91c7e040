/// closest_point_rectangle_perimeter in the tiers of the library collide::certified.
#include <collide/closest_point_rectangle_perimeter.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
ClosestPoint<T> closest_point_rectangle_perimeter(const Rectangle<T>& rectangle, const Vec3<T>& point) {
  return kernels::closest_point_rectangle_perimeter<InStages<Tier>>(rectangle, point);
}

template ClosestPoint<float> closest_point_rectangle_perimeter<Certified>(const Rectangle<float>&, const Vec3<float>&);
template ClosestPoint<double> closest_point_rectangle_perimeter<Certified>(const Rectangle<double>&,
                                                                           const Vec3<double>&);

}  // namespace collide::compiled
