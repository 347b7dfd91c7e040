/// When and where a moving point meets a sphere.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_point_sphere {
  using Answer = collide::Impact<T>;

  Vec3<T> point{};
  Vec3<T> velocity{};
  Sphere<T> sphere{};
  bool solid = true;

  static constexpr auto members() {
    return std::tuple(member("point", &moving_point_sphere::point, Role::position),
                      member("velocity", &moving_point_sphere::velocity, Role::velocity),
                      member("sphere", &moving_point_sphere::sphere),
                      member("solid", &moving_point_sphere::solid, Role::flag));
  }
};

}  // namespace nearmiss::inputs
