/// Whether an axis-aligned box and a triangle overlap.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct aabox_triangle_overlap {
  using Answer = collide::Decision<T>;

  AABox<T> box{};
  Triangle<T> triangle{};

  static constexpr auto members() {
    return std::tuple(member("box", &aabox_triangle_overlap::box),
                      member("triangle", &aabox_triangle_overlap::triangle));
  }

  static constexpr Traits traits{};
};

}  // namespace nearmiss::inputs
