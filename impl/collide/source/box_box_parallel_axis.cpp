/// box_box_parallel_axis in the tiers of the library collide::certified.
#include <collide/box_box_parallel_axis.hpp>

#include "stages.hpp"

namespace collide::compiled {

template <class Tier, class T>
ParallelAxes<T> box_box_parallel_axis(const Box<T>& box1, const Box<T>& box2, T epsilon) {
  return kernels::box_box_parallel_axis<InStages<Tier>>(box1, box2, epsilon);
}

template <class Tier, class T>
ParallelAxes<T> box_box_parallel_axis(const BoxBoxInfo<T>& info, T epsilon) {
  return kernels::box_box_parallel_axis<InStages<Tier>>(info, epsilon);
}

template ParallelAxes<float> box_box_parallel_axis<Certified>(const Box<float>&, const Box<float>&, float);
template ParallelAxes<double> box_box_parallel_axis<Certified>(const Box<double>&, const Box<double>&, double);
template ParallelAxes<float> box_box_parallel_axis<Certified>(const BoxBoxInfo<float>&, float);
template ParallelAxes<double> box_box_parallel_axis<Certified>(const BoxBoxInfo<double>&, double);

}  // namespace collide::compiled
