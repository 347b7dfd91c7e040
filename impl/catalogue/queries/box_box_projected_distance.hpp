/// How far two boxes lie apart along one of their axes.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct box_box_projected_distance {
  using Answer = collide::Measure<T>;

  Box<T> box1{}, box2{};
  int axis = 0;

  static constexpr auto members() {
    return std::tuple(member("box1", &box_box_projected_distance::box1),
                      member("box2", &box_box_projected_distance::box2),
                      member("axis", &box_box_projected_distance::axis, Role::index));
  }
  std::optional<Broken> broken() const {
    if (axis < 0 || axis >= box_box_axes) return Broken{"axis", "0 to 14", double(axis)};
    return std::nullopt;
  }

  static constexpr Traits traits{.exchange = Exchange::always};
};

}  // namespace nearmiss::inputs
