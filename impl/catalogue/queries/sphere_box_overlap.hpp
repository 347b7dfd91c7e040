/// Whether a sphere and a box overlap.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct sphere_box_overlap {
  using Answer = collide::Decision<T>;

  Sphere<T> sphere{};
  Box<T> box{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &sphere_box_overlap::sphere), member("box", &sphere_box_overlap::box));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::same_decision, .to = query_id("sphere_box_penetration")},
      {.kind = Link::Kind::contained_ball,
       .to = query_id("sphere_sphere_overlap"),
       .renamed = {{{"sphere1", "sphere"}, {"sphere2.center", "box.center"}}}},
      {.kind = Link::Kind::box_as_point,
       .to = query_id("sphere_sphere_overlap"),
       .renamed = {{{"sphere1", "sphere"}, {"sphere2.center", "box.center"}, {"sphere2.radius", "-"}}}},
  };
  static constexpr Traits traits{.grows = true, .links = links};
};

}  // namespace nearmiss::inputs
