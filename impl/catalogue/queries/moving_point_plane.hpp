/// When and where a moving point meets a one-sided plane.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_point_plane {
  using Answer = collide::Impact<T>;

  Vec3<T> point{};
  Vec3<T> velocity{};
  Plane<T> plane{};

  static constexpr auto members() {
    return std::tuple(member("point", &moving_point_plane::point, Role::position),
                      member("velocity", &moving_point_plane::velocity, Role::velocity),
                      member("plane", &moving_point_plane::plane));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::point_as_sphere,
       .to = query_id("moving_sphere_plane"),
       .renamed = {{{"sphere.center", "point"}}}},
      {.kind = Link::Kind::at_rest,
       .to = query_id("sphere_plane_penetration"),
       .renamed = {{{"sphere.center", "point"}, {"sphere.radius", "-"}}}},
      {.kind = Link::Kind::implied_decision,
       .to = query_id("moving_point_halfspace"),
       .renamed = {{{"halfspace", "plane"}}}},
  };
  static constexpr Traits traits{.one_sided = true, .links = links};
};

}  // namespace nearmiss::inputs
