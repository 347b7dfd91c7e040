/// The function takes a prepared triangle.
#pragma once

#include <tuple>

#include <collide/moving_point_triangle_prepared.hpp>

#include "impl/adapters/collide_function.hpp"
#include "impl/catalogue/queries/moving_point_triangle_prepared.hpp"

namespace nearmiss::adapters {

template <class T>
struct CollideArguments<inputs::moving_point_triangle_prepared<T>> {
  template <class Tier>
  static auto of(const inputs::moving_point_triangle_prepared<T>& q) noexcept {
    return std::tuple(q.point, q.velocity, collide::prepare_triangle<Tier>(q.triangle));
  }
};

}  // namespace nearmiss::adapters
