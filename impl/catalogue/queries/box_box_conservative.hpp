/// Whether two boxes may overlap, from their bounding spheres.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct box_box_conservative {
  using Answer = collide::Decision<T>;

  Box<T> box1{}, box2{};

  static constexpr auto members() {
    return std::tuple(member("box1", &box_box_conservative::box1), member("box2", &box_box_conservative::box2));
  }

  // Half diagonals that are sums of three squares hardly ever add up to a distance.
  static constexpr Traits traits{.decision = {"the distance of the centers is at most the sum of the half diagonals",
                                              "the distance of the centers is more than the sum of the half diagonals"},
                                 .touching_is_yes = false,
                                 .grows = true,
                                 .exchange = Exchange::always,
                                 .balance = {.knifes_edge_per_mille = 5, .either_percent = 8}};
};

}  // namespace nearmiss::inputs
