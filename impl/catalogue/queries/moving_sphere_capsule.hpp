/// When and where a moving sphere meets a capsule.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_sphere_capsule {
  using Answer = collide::Impact<T>;

  Sphere<T> sphere{};
  Vec3<T> velocity{};
  Capsule<T> capsule{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &moving_sphere_capsule::sphere),
                      member("velocity", &moving_sphere_capsule::velocity, Role::velocity),
                      member("capsule", &moving_sphere_capsule::capsule));
  }
};

}  // namespace nearmiss::inputs
