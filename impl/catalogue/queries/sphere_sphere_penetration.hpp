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

  static constexpr Traits traits{
      .grows = true, .contact_is_of_the_first = true, .exchange = Exchange::always, .ties = {Tie::cone}};
};

}  // namespace nearmiss::inputs
