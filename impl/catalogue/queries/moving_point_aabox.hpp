/// When and where a moving point enters an axis-aligned box.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_point_aabox {
  using Answer = collide::Entry<T>;

  Vec3<T> point{};
  Vec3<T> velocity{};
  AABox<T> aabox{};

  static constexpr auto members() {
    return std::tuple(member("point", &moving_point_aabox::point, Role::position),
                      member("velocity", &moving_point_aabox::velocity, Role::velocity),
                      member("aabox", &moving_point_aabox::aabox));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::implied_decision, .to = query_id("moving_point_span_aabox")},
      {.kind = Link::Kind::implied_decision,
       .to = query_id("ray_aabox"),
       .renamed = {{{"ray.origin", "point"}, {"ray.direction", "velocity"}}}},
  };
  static constexpr Traits traits{.ties = {Tie::normal}, .links = links};
};

}  // namespace nearmiss::inputs
