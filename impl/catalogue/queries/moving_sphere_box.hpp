/// When and where a moving sphere meets a box.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_sphere_box {
  using Answer = collide::Impact<T>;

  Sphere<T> sphere{};
  Vec3<T> velocity{};
  Box<T> box{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &moving_sphere_box::sphere),
                      member("velocity", &moving_sphere_box::velocity, Role::velocity),
                      member("box", &moving_sphere_box::box));
  }
};

}  // namespace nearmiss::inputs
