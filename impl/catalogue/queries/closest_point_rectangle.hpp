/// The point of a rectangle nearest to a point.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct closest_point_rectangle {
  using Answer = collide::ClosestPoint<T>;

  Rectangle<T> rectangle{};
  Vec3<T> point{};

  static constexpr auto members() {
    return std::tuple(member("rectangle", &closest_point_rectangle::rectangle),
                      member("point", &closest_point_rectangle::point, Role::position));
  }

  static constexpr Traits traits{.ties = {Tie::position}};
};

}  // namespace nearmiss::inputs
