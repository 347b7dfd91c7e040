/// How deep a sphere overlaps a box.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct sphere_box_penetration {
  using Answer = collide::Penetration<T>;

  Sphere<T> sphere{};
  Box<T> box{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &sphere_box_penetration::sphere),
                      member("box", &sphere_box_penetration::box));
  }
};

}  // namespace nearmiss::inputs
