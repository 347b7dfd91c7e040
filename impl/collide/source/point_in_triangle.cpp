/// point_in_triangle in the tiers of the library collide::certified.
#include <collide/point_in_triangle.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Containment<T> point_in_triangle(const Triangle<T>& triangle, const Vec3<T>& normal, int axis, const Vec3<T>& point) {
  return kernels::point_in_triangle<InStages<Tier>>(triangle, normal, axis, point);
}

template Containment<float> point_in_triangle<Certified>(const Triangle<float>&, const Vec3<float>&, int,
                                                         const Vec3<float>&);
template Containment<double> point_in_triangle<Certified>(const Triangle<double>&, const Vec3<double>&, int,
                                                          const Vec3<double>&);

}  // namespace collide::compiled
