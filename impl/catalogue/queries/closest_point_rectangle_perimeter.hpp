/// The point of a rectangle's perimeter nearest to a point.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct closest_point_rectangle_perimeter {
  using Answer = collide::ClosestPoint<T>;

  Rectangle<T> rectangle{};
  Vec3<T> point{};

  static constexpr auto members() {
    return std::tuple(member("rectangle", &closest_point_rectangle_perimeter::rectangle),
                      member("point", &closest_point_rectangle_perimeter::point, Role::position));
  }

  static constexpr Traits traits{.ties = {Tie::position}};
};

}  // namespace nearmiss::inputs
