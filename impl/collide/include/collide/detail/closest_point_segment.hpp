/// The kernel of closest_point_segment (collide/closest_point_segment.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(closest_point_segment)

namespace kernels {

template <class Tier, class T>
inline ClosestPoint<T> closest_point_segment(const Segment<T>& segment, const Vec3<T>& point) {
  if constexpr (Tier::template lifts<T>) {
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_foot(segment.v0, segment.v1, point))
        return Tier::decided_by_filter(*answer);
    }
    return COLLIDE_LIFTED(closest_point_segment, segment, point);
  } else {
    const Vec3<T> along = segment.v1 - segment.v0;
    const T projection = Tier::dot(point - segment.v0, along);
    const T length2 = Tier::dot(along, along);
    if (projection <= T(0)) return {segment.v0};
    if (projection >= length2) return {segment.v1};
    return {segment.v0 + along * (projection / length2)};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
