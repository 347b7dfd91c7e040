/// When and where a moving point meets a sphere.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_point_sphere {
  using Answer = collide::Impact<T>;

  Vec3<T> point{};
  Vec3<T> velocity{};
  Sphere<T> sphere{};
  bool solid = true;

  static constexpr auto members() {
    return std::tuple(member("point", &moving_point_sphere::point, Role::position),
                      member("velocity", &moving_point_sphere::velocity, Role::velocity),
                      member("sphere", &moving_point_sphere::sphere),
                      member("solid", &moving_point_sphere::solid, Role::flag));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::at_rest,
       .to = query_id("sphere_sphere_overlap"),
       .renamed = {{{"sphere1.center", "point"}, {"sphere1.radius", "-"}, {"sphere2", "sphere"}}}},
  };
  static constexpr Traits traits{.ties = {Tie::cone}, .links = links};
};

}  // namespace nearmiss::inputs
