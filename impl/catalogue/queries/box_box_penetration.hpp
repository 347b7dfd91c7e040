/// How deep two boxes overlap.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct box_box_penetration {
  using Answer = collide::BoxPenetration<T>;

  Box<T> box1{}, box2{};
  int hint = -1;

  static constexpr auto members() {
    return std::tuple(member("box1", &box_box_penetration::box1), member("box2", &box_box_penetration::box2),
                      member("hint", &box_box_penetration::hint, Role::index));
  }

  static constexpr Traits traits{
      .grows = true, .exchange = Exchange::always, .ties = {Tie::position, Tie::normal, Tie::depth, Tie::index}};
};

}  // namespace nearmiss::inputs
