/// The kernel of closest_point_segment_unit (collide/closest_point_segment_unit.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/prepared.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(closest_point_segment_unit)

namespace kernels {

template <class Tier, class T>
inline ClosestPoint<T> closest_point_segment_unit(const PreparedSegment<T>& prepared, const Vec3<T>& point) {
  if constexpr (!Tier::template computes_in<T>) {
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_foot(prepared.segment.v0, prepared.segment.v1, point))
        return Tier::decided_by_filter(*answer);
    }
    return Tier::lift(
        [](auto arithmetic, const auto& s, const auto& p) {
          return kernels::closest_point_segment_unit<decltype(arithmetic)>(prepare_segment<decltype(arithmetic)>(s), p);
        },
        prepared.segment, point);
  } else {
    const T distance = Tier::dot(point - prepared.segment.v0, prepared.direction);
    if (distance <= T(0)) return {prepared.segment.v0};
    if (distance >= prepared.length) return {prepared.segment.v1};
    return {prepared.segment.v0 + prepared.direction * distance};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
