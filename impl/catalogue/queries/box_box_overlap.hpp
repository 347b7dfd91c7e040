/// Whether two boxes overlap.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct box_box_overlap {
  using Answer = collide::BoxOverlap<T>;

  Box<T> box1{}, box2{};
  int hint = -1;

  static constexpr auto members() {
    return std::tuple(member("box1", &box_box_overlap::box1), member("box2", &box_box_overlap::box2),
                      member("hint", &box_box_overlap::hint, Role::index));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::same_decision, .to = query_id("box_box_penetration")},
      {.kind = Link::Kind::implied_decision, .to = query_id("box_box_conservative")},
  };
  static constexpr Traits traits{.grows = true, .exchange = Exchange::always, .ties = {Tie::index}, .links = links};
};

}  // namespace nearmiss::inputs
