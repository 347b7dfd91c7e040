/// Whether two boxes may overlap, from their bounding spheres.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct box_box_conservative {
  using Answer = collide::Decision<T>;

  Box<T> box1{}, box2{};

  static constexpr auto members() {
    return std::tuple(member("box1", &box_box_conservative::box1), member("box2", &box_box_conservative::box2));
  }
};

}  // namespace nearmiss::inputs
