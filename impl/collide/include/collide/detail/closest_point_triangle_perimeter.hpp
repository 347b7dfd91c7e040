/// The kernel of closest_point_triangle_perimeter (collide/closest_point_triangle_perimeter.hpp).
#pragma once

#include <collide/answers.hpp>
#include <collide/detail/edges.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

#if defined(COLLIDE_LANES)

namespace detail {

/// The kernel of `Fast` in lanes, with edge i in lane i. Calls `fallback` if an argument is not finite.
template <class T, class Fallback>
inline ClosestPoint<T> closest_point_triangle_perimeter_in_lanes(const Triangle<T>& triangle, const Vec3<T>& point,
                                                                 const Fallback& fallback) {
  using L = Lanes<T>;
  const auto [v0, v1, v2] = corner_lanes(triangle);
  const L p = lanes(point), all = v0 + v1 + v2 + p, zero = L::splat(T(0)), one = L::splat(T(1));
  if (!all_three(are_finite(all))) return fallback(triangle, point);
  const Columns<T> start = columns(v0, v1, v2, p), end = yzx(start);
  const Columns<T> along = end - start, to_query = start.template broadcast<3>() - start;
  const L length2 = dot(along, along);
  const L share = smaller(larger(dot(to_query, along) / length2, zero), one) & (zero < length2);
  const Columns<T> from_start = along * share, from_end = along * (share - (one & (zero < length2)));
  // The squared distance of the foot on the next edge minus that of this one, as next_distance2_excess computes it.
  const Columns<T> next = yzx(from_start), to_point = yzx(to_query);
  const L further = dot(next - from_end, (from_end - to_point) + (next - to_point));
  // Bit 0: edge 1 is no closer than edge 0. Bit 1: edge 2 is no closer than edge 1. Bit 2: edge 0 is no farther than
  // edge 2. A table avoids unpredictable branches.
  constexpr signed char nearest[] = {2, 2, 1, 2, 2, 0, 1, 0};
  const int edge = nearest[((zero <= further).bits() & 3) | ((further <= zero).bits() & 4)];
  const Columns<T> foot = select(share == one, end, start + from_start);
  const auto number = [edge](const L& lanes) { return to_array(lanes)[std::size_t(edge)]; };
  return {{number(foot.x), number(foot.y), number(foot.z)}};
}

}  // namespace detail

#endif

namespace kernels {

template <class Tier, class T>
inline ClosestPoint<T> closest_point_triangle_perimeter(const Triangle<T>& triangle, const Vec3<T>& point) {
  if constexpr (Tier::template lifts<T>) {
    const auto fallback = [](const auto&... inputs) {
      return Tier::lift(
          [](auto arithmetic, const auto&... a) {
            return kernels::closest_point_triangle_perimeter<decltype(arithmetic)>(a...);
          },
          inputs...);
    };
#if defined(COLLIDE_LANES)
    if constexpr (in_lanes<Tier, T>) {
      return detail::closest_point_triangle_perimeter_in_lanes(triangle, point, detail::out_of_line(fallback));
    }
#endif
    return fallback(triangle, point);
  } else {
    if constexpr (MachineNumber<T>) {
      if (const Vec3<T> all = triangle.v0 + triangle.v1 + triangle.v2 + point; !detail::is_finite(all)) return {all};
    }
    const std::array<Vec3<T>, 3> v = detail::corners(triangle);
    const std::array<detail::EdgeFoot<T>, 3> foot{detail::foot_on_edge<Tier>(v[0], v[1], point),
                                                  detail::foot_on_edge<Tier>(v[1], v[2], point),
                                                  detail::foot_on_edge<Tier>(v[2], v[0], point)};
    const int edge = detail::nearest_edge<Tier>(v, foot, point);
    return {foot[edge].on(v[edge], v[(edge + 1) % 3])};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
