/// Whether a sphere contains a polyline.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct sphere_contains_polyline {
  using Answer = collide::Decision<T>;

  Sphere<T> sphere{};
  collide::Polyline<T> polyline{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &sphere_contains_polyline::sphere),
                      member("polyline", &sphere_contains_polyline::polyline));
  }

  static constexpr Traits traits{.grows = true};
};

}  // namespace nearmiss::inputs
