/// The point of a segment nearest to a point.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct closest_point_segment {
  using Answer = collide::ClosestPoint<T>;

  Segment<T> segment{};
  Vec3<T> point{};

  static constexpr auto members() {
    return std::tuple(member("segment", &closest_point_segment::segment),
                      member("point", &closest_point_segment::point, Role::position));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::prepared, .to = query_id("closest_point_segment_unit")},
  };
  static constexpr Traits traits{.links = links};
};

}  // namespace nearmiss::inputs
