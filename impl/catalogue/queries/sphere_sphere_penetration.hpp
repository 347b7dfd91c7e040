/// How deep two spheres overlap.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct sphere_sphere_penetration {
  using Answer = collide::Penetration<T>;

  Sphere<T> sphere1{}, sphere2{};

  static constexpr auto members() {
    return std::tuple(member("sphere1", &sphere_sphere_penetration::sphere1),
                      member("sphere2", &sphere_sphere_penetration::sphere2));
  }
};

}  // namespace nearmiss::inputs
