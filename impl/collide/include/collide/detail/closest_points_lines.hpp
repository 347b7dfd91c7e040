/// The kernel of closest_points_lines (collide/closest_points_lines.hpp).
#pragma once

#include <limits>

#include <collide/answers.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

COLLIDE_COMPILED(closest_points_lines)

namespace kernels {

template <class Tier, class T>
inline ClosestPoints<T> closest_points_lines(const Line<T>& line1, const Line<T>& line2) {
  if constexpr (Tier::template lifts<T>) {
    if constexpr (uses_filter<Tier, T>) {
      if (const auto answer = detail::filtered_closest_points(line1, line2)) return Tier::decided_by_filter(*answer);
    }
    return COLLIDE_LIFTED(closest_points_lines, line1, line2);
  } else {
    const Vec3<T> normal = Tier::cross(line1.direction, line2.direction);
    const T normal2 = Tier::dot(normal, normal);
    Vec3<T> point1 = line1.point;
    if (!(normal2 <= T(0))) {
      const Vec3<T> between = line2.point - line1.point;
      point1 = point1 + line1.direction * (Tier::dot(Tier::cross(between, line2.direction), normal) / normal2);
    }
    const auto parameter_on_line2 = [&](const Vec3<T>& point) -> T {
      return Tier::dot(point - line2.point, line2.direction) / Tier::dot(line2.direction, line2.direction);
    };
    T along = parameter_on_line2(point1);
    if constexpr (MachineNumber<T>) {
      // An overflow. Within the range of the contract, the sine of the angle between the lines is then far below the
      // rounding error of a direction: the lines count as parallel.
      if (!(detail::abs(along) <= std::numeric_limits<T>::max())) {
        point1 = line1.point;
        along = parameter_on_line2(point1);
      }
    }
    return {point1, line2.point + line2.direction * along};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
