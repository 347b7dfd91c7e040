/// The signed distance of two boxes with the same orientation, in numbers that decide: along each of the three common
/// axes the boxes are two intervals. By features, each edge of one box is parallel to an edge of the other, and each
/// product of two of them is a zero that only exact numbers prove.
#pragma once

#include <array>

#include <collide/answers.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/machine_math.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// Whether two boxes have the same orientation: their quaternions are equal or opposite.
template <MachineNumber T>
constexpr bool are_in_one_frame(const Box<T>& a, const Box<T>& b) {
  const Quaternion<T>&p = a.orientation, &q = b.orientation;
  return (p.x == q.x && p.y == q.y && p.z == q.z && p.w == q.w) ||
         (p.x == -q.x && p.y == -q.y && p.z == -q.z && p.w == -q.w);
}

}  // namespace detail

namespace kernels {

/// Apart, the shortest way leads along each axis on which the intervals are apart; overlapping, along one axis on which
/// they overlap by the least. Along the other axes the points are at the lower end of what both intervals share.
template <class Tier, class T>
SignedDistance<T> distance_in_one_frame(const Box<T>& a, const Box<T>& b) {
  using detail::abs, detail::sqrt;
  const Axes<T> axes = axes_of(a.orientation);
  const std::array<T, 3> between = into_frame<Tier>(axes, b.center - a.center);
  const std::array<T, 3> half = components(a.half), other = components(b.half);
  std::array<T, 3> gap;
  std::array<bool, 3> leads{};
  int most = 0, count = 0;
  for (int k = 0; k < 3; ++k) {
    gap[k] = abs(between[k]) - (half[k] + other[k]);
    leads[k] = gap[k] > T(0);
    count += int(leads[k]);
  }
  if (count == 0) {
    for (int k = 1; k < 3; ++k) most = gap[k] > gap[most] ? k : most;
    leads[most] = true, count = 1;
  }
  std::array<T, 3> way{}, from, to;
  T length2{};
  for (int k = 0; k < 3; ++k) {
    if (leads[k]) {
      const bool forth = between[k] >= T(0);
      from[k] = forth ? half[k] : -half[k];
      to[k] = forth ? between[k] - other[k] : between[k] + other[k];
      way[k] = forth ? gap[k] : -gap[k];
      length2 = length2 + gap[k] * gap[k];
    } else {
      from[k] = to[k] = larger(-half[k], between[k] - other[k]);
    }
  }
  const Vec3<T> point1 = a.center + out_of_frame(axes, from), point2 = a.center + out_of_frame(axes, to);
  for (int k = 0; k < 3 && count == 1; ++k) {
    if (leads[k]) return {gap[k], between[k] >= T(0) ? axes[k] : -axes[k], point1, point2};
  }
  const T distance = sqrt(length2);
  return {distance, out_of_frame(axes, way) * (T(1) / distance), point1, point2};
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
