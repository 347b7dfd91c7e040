/// closest_point_triangle_perimeter in the tiers of the library collide::certified.
#include <collide/closest_point_triangle_perimeter.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
ClosestPoint<T> closest_point_triangle_perimeter(const Triangle<T>& triangle, const Vec3<T>& point) {
  return kernels::closest_point_triangle_perimeter<InStages<Tier>>(triangle, point);
}

template ClosestPoint<float> closest_point_triangle_perimeter<Certified>(const Triangle<float>&, const Vec3<float>&);
template ClosestPoint<double> closest_point_triangle_perimeter<Certified>(const Triangle<double>&, const Vec3<double>&);

}  // namespace collide::compiled
