/// aabox_triangle_overlap in the tiers of the library collide::certified.
#include <collide/aabox_triangle_overlap.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
Decision<T> aabox_triangle_overlap(const AABox<T>& box, const Triangle<T>& triangle) {
  return kernels::aabox_triangle_overlap<InStages<Tier>>(box, triangle);
}

template Decision<float> aabox_triangle_overlap<Certified>(const AABox<float>&, const Triangle<float>&);
template Decision<double> aabox_triangle_overlap<Certified>(const AABox<double>&, const Triangle<double>&);

}  // namespace collide::compiled
