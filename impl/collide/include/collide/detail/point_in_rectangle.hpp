/// The kernel of point_in_rectangle (collide/point_in_rectangle.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/point_in_triangle.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// Filter: whether the point certainly lies in a rectangle, both projected along the axis; or nullopt.
///
/// An edge function has an error of 4 u (u = 2^-53) of the sum of its terms' magnitudes, and of 2^-1074 for each
/// product that underflows. The filter uses a bound of 8 u.
template <class T>
std::optional<bool> certainly_inside(const Rectangle<T>& rectangle, int axis, const Vec3<T>& point) {
  const std::size_t a = std::size_t(axis + 1) % 3, b = std::size_t(axis + 2) % 3;
  const std::array<Vec3<T>, 4> corner{rectangle.v0, rectangle.v1, rectangle.v2, rectangle.v3};
  const std::array<T, 3> at = components(point);
  std::array<double, 4> from_a, from_b;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::array<T, 3> place = components(corner[i]);
    from_a[i] = double(place[a]) - double(at[a]), from_b[i] = double(place[b]) - double(at[b]);
  }
  // The side of an edge on which the point certainly lies: +1 or -1, or 0.
  const auto side = [&](std::size_t start, std::size_t end) {
    const double p = from_a[start] * from_b[end], q = from_a[end] * from_b[start];
    const double bound = 0x1p-50 * (detail::abs(p) + detail::abs(q)) + 0x1p-1000;
    return int(p - q > bound) - int(q - p > bound);
  };
  const int diagonal = side(2, 0);
  const std::array<std::array<int, 3>, 2> sides{
      {{side(0, 1), side(1, 2), diagonal}, {-diagonal, side(2, 3), side(3, 0)}}};
  const auto is_in = [](const std::array<int, 3>& s) { return s[0] != 0 && s[0] == s[1] && s[1] == s[2]; };
  const auto is_out = [](const std::array<int, 3>& s) {
    return std::max({s[0], s[1], s[2]}) > 0 && std::min({s[0], s[1], s[2]}) < 0;
  };
  if (is_out(sides[0]) && is_out(sides[1])) return false;
  if ((is_in(sides[0]) || is_in(sides[1])) && all_finite(rectangle, point)) return true;
  return std::nullopt;
}

}  // namespace detail

COLLIDE_COMPILED(point_in_rectangle)

namespace kernels {

template <class Tier, class T>
inline Decision<T> point_in_rectangle(const Rectangle<T>& rectangle, const Vec3<T>& normal, const Vec3<T>& point) {
  if constexpr (Tier::template lifts<T>) {
    if constexpr (uses_filter<Tier, T>) {
      if (detail::is_finite(normal)) {
        const int axis = detail::largest_component(normal);
        if (const auto inside = detail::certainly_inside(rectangle, axis, point))
          return Tier::decided_by_filter(Decision<T>{*inside});
      }
    }
    return COLLIDE_LIFTED(point_in_rectangle, rectangle, normal, point);
  } else {
    if constexpr (MachineNumber<T>) {
      if (!detail::is_finite(normal)) return {};
    }
    const int axis = detail::largest_component(normal);
    return {detail::is_inside<Tier>({rectangle.v0, rectangle.v1, rectangle.v2}, axis, point) ||
            detail::is_inside<Tier>({rectangle.v0, rectangle.v2, rectangle.v3}, axis, point)};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
