/// When and where a moving point meets a one-sided triangle.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_point_triangle {
  using Answer = collide::Impact<T>;

  Vec3<T> point{};
  Vec3<T> velocity{};
  Triangle<T> triangle{};

  static constexpr auto members() {
    return std::tuple(member("point", &moving_point_triangle::point, Role::position),
                      member("velocity", &moving_point_triangle::velocity, Role::velocity),
                      member("triangle", &moving_point_triangle::triangle));
  }
};

}  // namespace nearmiss::inputs
