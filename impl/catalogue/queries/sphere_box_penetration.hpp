/// How deep a sphere overlaps a box.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct sphere_box_penetration {
  using Answer = collide::Penetration<T>;

  Sphere<T> sphere{};
  Box<T> box{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &sphere_box_penetration::sphere), member("box", &sphere_box_penetration::box));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::box_as_point,
       .to = query_id("sphere_sphere_penetration"),
       .renamed = {{{"sphere1", "sphere"}, {"sphere2.center", "box.center"}, {"sphere2.radius", "-"}}},
       .except = {"contact", "normal"}},
  };
  static constexpr Traits traits{.grows = true, .ties = {Tie::position, Tie::normal, Tie::cone}, .links = links};
};

}  // namespace nearmiss::inputs
