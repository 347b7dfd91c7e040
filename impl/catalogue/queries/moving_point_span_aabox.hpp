/// The times at which a moving point is in an axis-aligned box.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_point_span_aabox {
  using Answer = collide::Span<T>;

  Vec3<T> point{};
  Vec3<T> velocity{};
  AABox<T> aabox{};

  static constexpr auto members() {
    return std::tuple(member("point", &moving_point_span_aabox::point, Role::position),
                      member("velocity", &moving_point_span_aabox::velocity, Role::velocity),
                      member("aabox", &moving_point_span_aabox::aabox));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::implied_decision,
       .to = query_id("ray_aabox"),
       .renamed = {{{"ray.origin", "point"}, {"ray.direction", "velocity"}}}},
  };
  static constexpr Traits traits{.links = links};
};

}  // namespace nearmiss::inputs
