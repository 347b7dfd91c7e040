/// The times at which a moving point is in a sphere.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_point_span_sphere {
  using Answer = collide::Span<T>;

  Vec3<T> point{};
  Vec3<T> velocity{};
  Sphere<T> sphere{};

  static constexpr auto members() {
    return std::tuple(member("point", &moving_point_span_sphere::point, Role::position),
                      member("velocity", &moving_point_span_sphere::velocity, Role::velocity),
                      member("sphere", &moving_point_span_sphere::sphere));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::same_decision, .to = query_id("moving_point_sphere"), .set = {"solid", 1}},
  };
  static constexpr Traits traits{.links = links};
};

}  // namespace nearmiss::inputs
