/// closest_point_segment_unit in the tiers of the library collide::certified.
#include <collide/closest_point_segment_unit.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
ClosestPoint<T> closest_point_segment_unit(const PreparedSegment<T>& prepared, const Vec3<T>& point) {
  return kernels::closest_point_segment_unit<InStages<Tier>>(prepared, point);
}

template ClosestPoint<float> closest_point_segment_unit<Certified>(const PreparedSegment<float>&, const Vec3<float>&);
template ClosestPoint<double> closest_point_segment_unit<Certified>(const PreparedSegment<double>&,
                                                                    const Vec3<double>&);

}  // namespace collide::compiled
