/// The signed distance of two boxes with the same orientation: along each of the three common axes the boxes are two
/// intervals. By features, each edge of one box is parallel to an edge of the other, and each product of two of them is
/// a zero that only exact numbers prove.
#pragma once

#include <array>
#include <cstddef>

#include <collide/answers.hpp>
#include <collide/detail/double_word.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/machine_math.hpp>
#include <collide/detail/overlaps.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// Whether a * b = c * d exactly; no where a product may have underflowed.
inline bool are_equal_products(float a, float b, float c, float d) {
  return double(a) * double(b) == double(c) * double(d);
}
inline bool are_equal_products(double a, double b, double c, double d) {
  using Product = DoubleWord<double>;
  const Product first = Product::two_product(a, b), second = Product::two_product(c, d);
  const bool exact = abs(first.high) >= 0x1p-900 || ((a == 0 || b == 0) && (c == 0 || d == 0));
  return exact && first == second;
}
inline bool are_equal_products(long double, long double, long double, long double) { return false; }

/// Whether two boxes have the same orientation: one quaternion is a multiple of the other.
template <MachineNumber T>
bool are_in_one_frame(const Box<T>& a, const Box<T>& b) {
  const Quaternion<T>&p = a.orientation, &q = b.orientation;
  const std::array<T, 4> first{p.x, p.y, p.z, p.w}, second{q.x, q.y, q.z, q.w};
  std::size_t largest = 0;
  for (std::size_t k = 1; k < 4; ++k) largest = abs(first[k]) > abs(first[largest]) ? k : largest;
  bool same = second[largest] != T(0);
  for (std::size_t k = 0; k < 4; ++k)
    same = same && are_equal_products(first[largest], second[k], second[largest], first[k]);
  return same;
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
    if (leads[k]) most = k, ++count;
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
  const Vec3<T> axis = between[most] >= T(0) ? axes[most] : -axes[most], out = out_of_frame(axes, way);
  if constexpr (MachineNumber<T>) {  // axes are rounded, and squares of extreme numbers leave the range
    const Vec3<T> direction = detail::of_moderate_length(count == 1 ? axis : out);
    const Vec3<T> normal = direction * (T(1) / sqrt(Tier::dot(direction, direction)));
    return {count == 1 ? gap[most] : Tier::dot(out, normal), normal, point1, point2};
  } else {
    if (count == 1) return {gap[most], axis, point1, point2};
    const T distance = sqrt(length2);
    return {distance, out * (T(1) / distance), point1, point2};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
