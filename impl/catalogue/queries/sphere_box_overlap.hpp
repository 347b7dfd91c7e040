/// Whether a sphere and a box overlap.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct sphere_box_overlap {
  using Answer = collide::Decision<T>;

  Sphere<T> sphere{};
  Box<T> box{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &sphere_box_overlap::sphere), member("box", &sphere_box_overlap::box));
  }
};

}  // namespace nearmiss::inputs
