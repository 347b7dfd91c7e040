/// Whether a sphere and a triangle overlap.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct sphere_triangle_overlap {
  using Answer = collide::Decision<T>;

  Sphere<T> sphere{};
  Triangle<T> triangle{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &sphere_triangle_overlap::sphere),
                      member("triangle", &sphere_triangle_overlap::triangle));
  }

  static constexpr Traits traits{.grows = true};
};

}  // namespace nearmiss::inputs
