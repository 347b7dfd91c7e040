/// Whether a sphere contains a point.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct sphere_contains_point {
  using Answer = collide::Decision<T>;

  Sphere<T> sphere{};
  Vec3<T> point{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &sphere_contains_point::sphere),
                      member("point", &sphere_contains_point::point, Role::position));
  }

  static constexpr Traits traits{.grows = true};
};

}  // namespace nearmiss::inputs
