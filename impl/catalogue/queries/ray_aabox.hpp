/// Whether and where a ray meets an axis-aligned box.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct ray_aabox {
  using Answer = collide::RayHit<T>;

  Ray<T> ray{};
  AABox<T> aabox{};

  static constexpr auto members() {
    return std::tuple(member("ray", &ray_aabox::ray), member("aabox", &ray_aabox::aabox));
  }

  static constexpr Traits traits{};
};

}  // namespace nearmiss::inputs
