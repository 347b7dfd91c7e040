/// When and where a moving sphere meets a one-sided rectangle.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_sphere_rectangle {
  using Answer = collide::Impact<T>;

  Sphere<T> sphere{};
  Vec3<T> velocity{};
  Rectangle<T> rectangle{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &moving_sphere_rectangle::sphere),
                      member("velocity", &moving_sphere_rectangle::velocity, Role::velocity),
                      member("rectangle", &moving_sphere_rectangle::rectangle));
  }
};

}  // namespace nearmiss::inputs
