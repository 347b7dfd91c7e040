/// The times at which a moving point is in a capsule.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_point_span_capsule {
  using Answer = collide::Span<T>;

  Vec3<T> point{};
  Vec3<T> velocity{};
  Capsule<T> capsule{};

  static constexpr auto members() {
    return std::tuple(member("point", &moving_point_span_capsule::point, Role::position),
                      member("velocity", &moving_point_span_capsule::velocity, Role::velocity),
                      member("capsule", &moving_point_span_capsule::capsule));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::capsule_as_sphere,
       .to = query_id("moving_point_span_sphere"),
       .renamed = {{{"sphere.center", "capsule.p0"}, {"sphere.radius", "capsule.radius"}}}},
  };
  static constexpr Traits traits{.links = links};
};

}  // namespace nearmiss::inputs
