/// When and where a moving point enters a capsule.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_point_capsule {
  using Answer = collide::Impact<T>;

  Vec3<T> point{};
  Vec3<T> velocity{};
  Capsule<T> capsule{};

  static constexpr auto members() {
    return std::tuple(member("point", &moving_point_capsule::point, Role::position),
                      member("velocity", &moving_point_capsule::velocity, Role::velocity),
                      member("capsule", &moving_point_capsule::capsule));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::capsule_as_sphere,
       .to = query_id("moving_point_sphere"),
       .renamed = {{{"sphere.center", "capsule.p0"}, {"sphere.radius", "capsule.radius"}}},
       .set = {"solid", 1},
       .times_alone = true},
      {.kind = Link::Kind::implied_decision, .to = query_id("moving_point_span_capsule")},
  };
  static constexpr Traits traits{.ties = {Tie::cone}, .links = links};
};

}  // namespace nearmiss::inputs
