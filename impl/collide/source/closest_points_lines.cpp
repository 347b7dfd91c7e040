/// closest_points_lines in the tiers of the library collide::certified.
#include <collide/closest_points_lines.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
ClosestPoints<T> closest_points_lines(const Line<T>& line1, const Line<T>& line2) {
  return kernels::closest_points_lines<InStages<Tier>>(line1, line2);
}

template ClosestPoints<float> closest_points_lines<Certified>(const Line<float>&, const Line<float>&);
template ClosestPoints<double> closest_points_lines<Certified>(const Line<double>&, const Line<double>&);

}  // namespace collide::compiled
