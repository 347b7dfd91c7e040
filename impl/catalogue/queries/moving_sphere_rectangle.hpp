/// When and where a moving sphere meets a one-sided rectangle.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_sphere_rectangle {
  using Answer = collide::Impact<T>;

  Sphere<T> sphere{};
  Vec3<T> velocity{};
  Rectangle<T> rectangle{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &moving_sphere_rectangle::sphere),
                      member("velocity", &moving_sphere_rectangle::velocity, Role::velocity),
                      member("rectangle", &moving_sphere_rectangle::rectangle));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::halves, .to = query_id("moving_sphere_triangle")},
  };
  static constexpr Traits traits{
      .one_sided = true, .grows = true, .ties = {Tie::position, Tie::normal, Tie::cone}, .links = links};
};

}  // namespace nearmiss::inputs
