/// When and where a moving point enters a box.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_point_box {
  using Answer = collide::Impact<T>;

  Vec3<T> point{};
  Vec3<T> velocity{};
  Box<T> box{};

  static constexpr auto members() {
    return std::tuple(member("point", &moving_point_box::point, Role::position),
                      member("velocity", &moving_point_box::velocity, Role::velocity),
                      member("box", &moving_point_box::box));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::implied_decision, .to = query_id("moving_point_span_box")},
      {.kind = Link::Kind::at_rest,
       .to = query_id("sphere_box_overlap"),
       .renamed = {{{"sphere.center", "point"}, {"sphere.radius", "-"}}}},
  };
  static constexpr Traits traits{.ties = {Tie::cone}, .links = links};
};

}  // namespace nearmiss::inputs
