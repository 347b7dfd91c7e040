/// The function takes a triangle with prepared edges.
#pragma once

#include <tuple>

#include <collide/closest_point_triangle_perimeter_edges.hpp>

#include "impl/adapters/collide_function.hpp"
#include "impl/catalogue/queries/closest_point_triangle_perimeter_edges.hpp"

namespace nearmiss::adapters {

template <class T>
struct CollideArguments<inputs::closest_point_triangle_perimeter_edges<T>> {
  template <class Tier>
  static auto of(const inputs::closest_point_triangle_perimeter_edges<T>& q) noexcept {
    return std::tuple(collide::prepare_triangle_edges<Tier>(q.triangle), q.point);
  }
};

}  // namespace nearmiss::adapters
