/// The kernel of closest_point_triangle_perimeter (collide/closest_point_triangle_perimeter.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/edges.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/detail/wide_lanes.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

#if defined(COLLIDE_LANES)

namespace detail {

/// The closest edge, where lane i has the squared distance of the next edge minus that of edge i.
template <class T>
int nearest_of_edges(const Lanes<T>& further) {
  const Lanes<T> zero = Lanes<T>::splat(T(0));
  // Bit 0: edge 1 is no closer than edge 0. Bit 1: edge 2 is no closer than edge 1. Bit 2: edge 0 is no farther than
  // edge 2. A table avoids unpredictable branches.
  constexpr signed char nearest[] = {2, 2, 1, 2, 2, 0, 1, 0};
  return nearest[((zero <= further).bits() & 3) | ((further <= zero).bits() & 4)];
}

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
  const int edge = nearest_of_edges(further);
  const Columns<T> foot = select(share == one, end, start + from_start);
  const auto number = [edge](const L& lanes) { return to_array(lanes)[std::size_t(edge)]; };
  return {{number(foot.x), number(foot.y), number(foot.z)}};
}

/// Filter: the index of an edge that contains the point of the perimeter closest to a given point, or -1.
///
/// Let u = 2^-53, and S the sum of the magnitudes of the three vectors from a corner to the point: no edge is longer. A
/// foot has an error of 14 u S relative to an end of its edge (filtered_foot), or of less than 2^-500 where a square
/// underflows. The two factors of a difference of squared distances are at most 2 S and 4 S and have errors of 30 u S
/// and 38 u S, so the difference has an error of at most 220 u S^2. Where it is smaller, the edges are certainly as
/// close only if the common corner is the foot on both: products with edges have errors of at most 10 u S^2.
template <class T>
inline int certainly_nearest_edge(const Triangle<T>& triangle, const Vec3<T>& point) {
  using L = Lanes<double>;
  const auto [v0, v1, v2] = corner_lanes(triangle);
  const L p = in_doubles(lanes(point)), zero = L::splat(0.0), one = L::splat(1.0);
  const Columns<double> start = columns(in_doubles(v0), in_doubles(v1), in_doubles(v2), p);
  const Columns<double> along = yzx(start) - start, to_query = start.template broadcast<3>() - start;
  const L sizes = absolute(to_query.x) + absolute(to_query.y) + absolute(to_query.z);
  const L size = sum_of_three(sizes);
  const L length2 = dot(along, along), has_length = zero < length2;
  const L product = dot(to_query, along), share = smaller(larger(product / length2, zero), one) & has_length;
  const Columns<double> from_start = along * share, from_end = along * (share - (one & has_length));
  const Columns<double> next = yzx(from_start), to_point = yzx(to_query);
  const L further = dot(next - from_end, (from_end - to_point) + (next - to_point));
  const L bound = L::splat(0x1p-48) * size * size;
  const L same_corner = (bound < product - length2) & yzx(product < zero - bound);
  const L certain = (L::splat(8) * bound < absolute(further)) | same_corner;
  if (!(size.first() >= 0x1p-200 && size.first() <= 0x1p200 && all_three(certain))) return -1;
  return nearest_of_edges(further);
}

/// Filter: the closest point of the perimeter and its edge. `foot` is nullopt if one of them is not certain.
template <class T>
struct CertainEdge {
  int edge = 0;
  std::optional<ClosestPoint<T>> foot;
};
template <class T>
CertainEdge<T> filtered_edge(const Triangle<T>& triangle, const Vec3<T>& point) {
  const int edge = certainly_nearest_edge(triangle, point);
  if (edge < 0) return {};
  const std::array<Vec3<T>, 3> v = corners(triangle);
  return {edge, filtered_foot(v[std::size_t(edge)], v[std::size_t(edge + 1) % 3], point)};
}

}  // namespace detail

#endif

COLLIDE_COMPILED(closest_point_triangle_perimeter)

namespace kernels {

template <class Tier, class T>
inline ClosestPoint<T> closest_point_triangle_perimeter(const Triangle<T>& triangle, const Vec3<T>& point) {
  if constexpr (Tier::template lifts<T>) {
    const auto fallback = [](const auto&... inputs) {
      return COLLIDE_LIFTED(closest_point_triangle_perimeter, inputs...);
    };
#if defined(COLLIDE_LANES)
    if constexpr (in_lanes<Tier, T>) {
      return detail::closest_point_triangle_perimeter_in_lanes(triangle, point, detail::out_of_line(fallback));
    }
    if constexpr (uses_filter<Tier, T>) {
      if (const auto nearest = detail::filtered_edge(triangle, point); nearest.foot)
        return Tier::decided_by_filter(*nearest.foot);
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
