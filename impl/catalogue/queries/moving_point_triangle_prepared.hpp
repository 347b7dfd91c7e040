/// When and where a moving point meets a one-sided triangle that is prepared for many calls.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_point_triangle_prepared {
  using Answer = collide::Impact<T>;

  Vec3<T> point{};
  Vec3<T> velocity{};
  Triangle<T> triangle{};

  static constexpr auto members() {
    return std::tuple(member("point", &moving_point_triangle_prepared::point, Role::position),
                      member("velocity", &moving_point_triangle_prepared::velocity, Role::velocity),
                      member("triangle", &moving_point_triangle_prepared::triangle));
  }

  static constexpr Traits traits{.one_sided = true};
};

}  // namespace nearmiss::inputs
