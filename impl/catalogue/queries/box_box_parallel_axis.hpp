/// Which axes of two boxes are parallel.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct box_box_parallel_axis {
  using Answer = collide::ParallelAxes<T>;

  Box<T> box1{}, box2{};
  T epsilon{};

  static constexpr auto members() {
    return std::tuple(member("box1", &box_box_parallel_axis::box1), member("box2", &box_box_parallel_axis::box2),
                      member("epsilon", &box_box_parallel_axis::epsilon, Role::weight));
  }

  static constexpr Traits traits{
      .decision = {"an axis of box 1 and one of box 2 are parallel", "no axis of box 1 is parallel to one of box 2"},
      .touching_is_yes = false,
      .frame = OutputFrame::order_of_axes};
};

}  // namespace nearmiss::inputs
