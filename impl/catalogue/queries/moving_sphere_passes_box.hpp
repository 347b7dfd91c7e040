/// Whether a moving sphere touches a box within a time.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_sphere_passes_box {
  using Answer = collide::Decision<T>;

  Sphere<T> sphere{};
  Vec3<T> velocity{};
  Box<T> box{};
  T limit{};
  bool forever = false;  ///< no limit: `limit` is ignored

  static constexpr auto members() {
    return std::tuple(member("sphere", &moving_sphere_passes_box::sphere),
                      member("velocity", &moving_sphere_passes_box::velocity, Role::velocity),
                      member("box", &moving_sphere_passes_box::box),
                      member("limit", &moving_sphere_passes_box::limit, Role::time),
                      member("forever", &moving_sphere_passes_box::forever, Role::flag));
  }
  std::optional<Broken> broken() const {
    if (limit < T(0)) return Broken{"limit", "not negative", double(limit)};
    return std::nullopt;
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::contained_ball,
       .to = query_id("moving_sphere_passes_sphere"),
       .renamed = {{{"fixed.center", "box.center"}}}},
  };
  static constexpr Traits traits{.grows = true, .links = links};
};

}  // namespace nearmiss::inputs
