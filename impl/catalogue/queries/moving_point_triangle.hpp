/// When and where a moving point meets a one-sided triangle.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_point_triangle {
  using Answer = collide::Impact<T>;

  Vec3<T> point{};
  Vec3<T> velocity{};
  Triangle<T> triangle{};

  static constexpr auto members() {
    return std::tuple(member("point", &moving_point_triangle::point, Role::position),
                      member("velocity", &moving_point_triangle::velocity, Role::velocity),
                      member("triangle", &moving_point_triangle::triangle));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::prepared, .to = query_id("moving_point_triangle_prepared")},
      {.kind = Link::Kind::point_as_sphere,
       .to = query_id("moving_sphere_triangle"),
       .renamed = {{{"sphere.center", "point"}}}},
      {.kind = Link::Kind::at_rest,
       .to = query_id("sphere_triangle_overlap"),
       .renamed = {{{"sphere.center", "point"}, {"sphere.radius", "-"}}}},
  };
  static constexpr Traits traits{.one_sided = true, .links = links};
};

}  // namespace nearmiss::inputs
