/// When and where a moving sphere meets a one-sided plane.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_sphere_plane {
  using Answer = collide::Impact<T>;

  Sphere<T> sphere{};
  Vec3<T> velocity{};
  Plane<T> plane{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &moving_sphere_plane::sphere),
                      member("velocity", &moving_sphere_plane::velocity, Role::velocity),
                      member("plane", &moving_sphere_plane::plane));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::at_rest, .to = query_id("sphere_plane_penetration")},
      {.kind = Link::Kind::implied_decision,
       .to = query_id("moving_sphere_halfspace"),
       .renamed = {{{"halfspace", "plane"}}}},
  };
  static constexpr Traits traits{.one_sided = true, .grows = true, .ties = {Tie::normal}, .links = links};
};

}  // namespace nearmiss::inputs
