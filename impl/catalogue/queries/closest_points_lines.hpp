/// The nearest points of two lines.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct closest_points_lines {
  using Answer = collide::ClosestPoints<T>;

  Line<T> line1{}, line2{};

  static constexpr auto members() {
    return std::tuple(member("line1", &closest_points_lines::line1), member("line2", &closest_points_lines::line2));
  }

  static constexpr Traits traits{.directions_are_lines = true, .exchange = Exchange::unless_nearly_parallel};
};

}  // namespace nearmiss::inputs
