/// closest_point_segment in the tiers of the library collide::certified.
#include <collide/closest_point_segment.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
ClosestPoint<T> closest_point_segment(const Segment<T>& segment, const Vec3<T>& point) {
  return kernels::closest_point_segment<InStages<Tier>>(segment, point);
}

template ClosestPoint<float> closest_point_segment<Certified>(const Segment<float>&, const Vec3<float>&);
template ClosestPoint<double> closest_point_segment<Certified>(const Segment<double>&, const Vec3<double>&);

}  // namespace collide::compiled
