/// closest_point_triangle_perimeter_edges in the tiers of the library collide::certified.
#include <collide/closest_point_triangle_perimeter_edges.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
EdgePoint<T> closest_point_triangle_perimeter_edges(const PreparedTriangleEdges<T>& prepared, const Vec3<T>& point) {
  return kernels::closest_point_triangle_perimeter_edges<InStages<Tier>>(prepared, point);
}

template EdgePoint<float> closest_point_triangle_perimeter_edges<Certified>(const PreparedTriangleEdges<float>&,
                                                                            const Vec3<float>&);
template EdgePoint<double> closest_point_triangle_perimeter_edges<Certified>(const PreparedTriangleEdges<double>&,
                                                                             const Vec3<double>&);

}  // namespace collide::compiled
