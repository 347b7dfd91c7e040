/// The function takes a prepared segment.
#pragma once

#include <tuple>

#include <collide/closest_point_segment_unit.hpp>

#include "impl/adapters/collide_function.hpp"
#include "impl/catalogue/queries/closest_point_segment_unit.hpp"

namespace nearmiss::adapters {

template <class T>
struct CollideArguments<inputs::closest_point_segment_unit<T>> {
  template <class Tier>
  static auto of(const inputs::closest_point_segment_unit<T>& q) noexcept {
    return std::tuple(collide::prepare_segment<Tier>(q.segment), q.point);
  }
};

}  // namespace nearmiss::adapters
