/// When and where a moving sphere meets a fixed one.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_sphere_sphere {
  using Answer = collide::Impact<T>;

  Sphere<T> sphere{};
  Vec3<T> velocity{};
  Sphere<T> fixed{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &moving_sphere_sphere::sphere),
                      member("velocity", &moving_sphere_sphere::velocity, Role::velocity),
                      member("fixed", &moving_sphere_sphere::fixed));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::within_any_time, .to = query_id("moving_sphere_passes_sphere"), .set = {"forever", 1}},
      {.kind = Link::Kind::at_rest,
       .to = query_id("sphere_sphere_overlap"),
       .renamed = {{{"sphere1", "sphere"}, {"sphere2", "fixed"}}}},
  };
  static constexpr Traits traits{.grows = true, .ties = {Tie::cone}, .links = links};
};

}  // namespace nearmiss::inputs
