/// When and where a moving sphere meets a capsule.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_sphere_capsule {
  using Answer = collide::Impact<T>;

  Sphere<T> sphere{};
  Vec3<T> velocity{};
  Capsule<T> capsule{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &moving_sphere_capsule::sphere),
                      member("velocity", &moving_sphere_capsule::velocity, Role::velocity),
                      member("capsule", &moving_sphere_capsule::capsule));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::contained_ball,
       .to = query_id("moving_sphere_sphere"),
       .renamed = {{{"fixed.center", "capsule.p0"}}}},
      {.kind = Link::Kind::sphere_as_point,
       .to = query_id("moving_point_capsule"),
       .renamed = {{{"point", "sphere.center"}}}},
      {.kind = Link::Kind::capsule_as_sphere,
       .to = query_id("moving_sphere_sphere"),
       .renamed = {{{"fixed.center", "capsule.p0"}, {"fixed.radius", "capsule.radius"}}}},
  };
  static constexpr Traits traits{.grows = true, .ties = {Tie::position, Tie::cone}, .links = links};
};

}  // namespace nearmiss::inputs
