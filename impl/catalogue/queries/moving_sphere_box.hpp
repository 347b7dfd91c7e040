/// When and where a moving sphere meets a box.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_sphere_box {
  using Answer = collide::Impact<T>;

  Sphere<T> sphere{};
  Vec3<T> velocity{};
  Box<T> box{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &moving_sphere_box::sphere),
                      member("velocity", &moving_sphere_box::velocity, Role::velocity),
                      member("box", &moving_sphere_box::box));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::within_any_time, .to = query_id("moving_sphere_passes_box"), .set = {"forever", 1}},
      {.kind = Link::Kind::contained_ball,
       .to = query_id("moving_sphere_sphere"),
       .renamed = {{{"fixed.center", "box.center"}}}},
      {.kind = Link::Kind::sphere_as_point,
       .to = query_id("moving_point_box"),
       .renamed = {{{"point", "sphere.center"}}}},
      {.kind = Link::Kind::box_as_point,
       .to = query_id("moving_sphere_sphere"),
       .renamed = {{{"fixed.center", "box.center"}, {"fixed.radius", "-"}}}},
      {.kind = Link::Kind::at_rest, .to = query_id("sphere_box_overlap")},
  };
  static constexpr Traits traits{.grows = true, .ties = {Tie::position, Tie::normal, Tie::cone}, .links = links};
};

}  // namespace nearmiss::inputs
