/// How deep a sphere reaches behind a plane.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct sphere_plane_penetration {
  using Answer = collide::Penetration<T>;

  Sphere<T> sphere{};
  Plane<T> plane{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &sphere_plane_penetration::sphere),
                      member("plane", &sphere_plane_penetration::plane));
  }

  static constexpr Traits traits{.grows = true};
};

}  // namespace nearmiss::inputs
