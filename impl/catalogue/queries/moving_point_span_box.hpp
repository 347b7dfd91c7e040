/// The times at which a moving point is in a box.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_point_span_box {
  using Answer = collide::Span<T>;

  Vec3<T> point{};
  Vec3<T> velocity{};
  Box<T> box{};

  static constexpr auto members() {
    return std::tuple(member("point", &moving_point_span_box::point, Role::position),
                      member("velocity", &moving_point_span_box::velocity, Role::velocity),
                      member("box", &moving_point_span_box::box));
  }

  static constexpr Traits traits{};
};

}  // namespace nearmiss::inputs
