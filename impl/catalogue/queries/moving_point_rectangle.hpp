/// When and where a moving point meets a one-sided rectangle.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_point_rectangle {
  using Answer = collide::Impact<T>;

  Vec3<T> point{};
  Vec3<T> velocity{};
  Rectangle<T> rectangle{};

  static constexpr auto members() {
    return std::tuple(member("point", &moving_point_rectangle::point, Role::position),
                      member("velocity", &moving_point_rectangle::velocity, Role::velocity),
                      member("rectangle", &moving_point_rectangle::rectangle));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::halves, .to = query_id("moving_point_triangle")},
      {.kind = Link::Kind::point_as_sphere,
       .to = query_id("moving_sphere_rectangle"),
       .renamed = {{{"sphere.center", "point"}}}},
  };
  static constexpr Traits traits{.one_sided = true, .ties = {Tie::normal}, .links = links};
};

}  // namespace nearmiss::inputs
