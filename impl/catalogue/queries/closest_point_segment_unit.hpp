/// The point of a segment nearest to a point, with the segment's unit direction and length at hand.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct closest_point_segment_unit {
  using Answer = collide::ClosestPoint<T>;

  Segment<T> segment{};
  Vec3<T> point{};

  static constexpr auto members() {
    return std::tuple(member("segment", &closest_point_segment_unit::segment),
                      member("point", &closest_point_segment_unit::point, Role::position));
  }

  static constexpr Traits traits{};
};

}  // namespace nearmiss::inputs
