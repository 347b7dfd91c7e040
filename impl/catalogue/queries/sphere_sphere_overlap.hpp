/// Whether two spheres overlap.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct sphere_sphere_overlap {
  using Answer = collide::Decision<T>;

  Sphere<T> sphere1{}, sphere2{};

  static constexpr auto members() {
    return std::tuple(member("sphere1", &sphere_sphere_overlap::sphere1),
                      member("sphere2", &sphere_sphere_overlap::sphere2));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::same_decision, .to = query_id("sphere_sphere_penetration")},
  };
  static constexpr Traits traits{.grows = true, .exchange = Exchange::always, .links = links};
};

}  // namespace nearmiss::inputs
