/// The intermediate values that the queries on pairs of boxes share.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct box_box_info {
  using Answer = collide::BoxBoxInfo<T>;

  Box<T> box1{}, box2{};

  static constexpr auto members() {
    return std::tuple(member("box1", &box_box_info::box1), member("box2", &box_box_info::box2));
  }

  static constexpr Traits traits{.frame = OutputFrame::operands};
};

}  // namespace nearmiss::inputs
