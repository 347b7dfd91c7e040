/// The filters of Certified for the closest points of a rectangle and of its perimeter.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/number.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/detail/wide_lanes.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

#if defined(COLLIDE_LANES)

namespace collide::detail {

template <class T>
std::array<Vec3<T>, 4> corners(const Rectangle<T>& r) {
  return {r.v0, r.v1, r.v2, r.v3};
}

/// The edges of a rectangle and a point, in doubles. Lane i has those of edge i, from corner i to corner i + 1; bit i
/// of a set is that of edge i. All sizes are in range where `in_range` is true: no product of six of them overflows,
/// and underflow costs less than 1 u.
///
/// Let u = 2^-53, and S the sum of the magnitudes of the four vectors from a corner to the point: no edge is longer. As
/// for the edges of a triangle (certainly_nearest_edge), a foot has an error of 14 u S, so its squared distance from
/// the point one of 35 u S^2, and a product with an edge one of at most 10 u S^2.
template <class T>
struct EdgesAndPoint {
  using L = Lanes<double>;

  Columns<double> along, to_point;  ///< from the start of each edge
  L distance2;                      ///< of the point from the foot on each edge, squared
  int at_start = 0, at_end = 0;     ///< edges whose foot is certainly the start, or the end
  double size = 0;                  ///< S
  bool in_range = false;

  EdgesAndPoint(const Rectangle<T>& r, const Vec3<T>& point) {
    const auto in_lanes = [](const Vec3<T>& v) COLLIDE_INLINE { return wide_lanes(v); };
    const Columns<double> start = columns(in_lanes(r.v0), in_lanes(r.v1), in_lanes(r.v2), in_lanes(r.v3));
    const L zero = L::splat(0.0), one = L::splat(1.0);
    along = next(start) - start;
    to_point = splat_columns(in_lanes(point)) - start;
    const L sizes = sum_of_four(absolute(to_point.x) + absolute(to_point.y) + absolute(to_point.z));
    size = sizes.first();
    in_range = size >= 0x1p-100 && size <= 0x1p100;
    const L length2 = dot(along, along), product = dot(to_point, along);
    const L share = smaller(larger(product / length2, zero), one) & (zero < length2);
    const Columns<double> away = to_point - along * share;
    distance2 = dot(away, away);
    const L bound = L::splat(0x1p-48) * sizes * sizes;
    at_start = (product < zero - bound).bits();
    at_end = (bound < product - length2).bits();
  }

  static L next(const L& a) { return a.template shuffled<1, 2, 3, 0>(); }
  static Columns<double> next(const Columns<double>& a) { return {next(a.x), next(a.y), next(a.z)}; }

  /// Two squared distances are certainly in order if they differ by more: their errors sum to 70 u S^2.
  double bound_of_distance2() const { return 0x1p-46 * size * size; }

  /// An edge that is certainly nearest, or -1. Two edges are certainly as near where both feet are their common corner.
  int certainly_nearest() const {
    const TwoDoubles pairwise = smaller(distance2.low, distance2.high), least = smaller(pairwise, swapped(pairwise));
    const int is_least = (distance2 <= L{least, least}).bits();
    const auto best = unsigned(is_least & 1 ? 0 : is_least & 2 ? 1 : is_least & 4 ? 2 : 3);
    int others = (distance2 <= L::splat(least.first() + bound_of_distance2())).bits() & ~(1 << best);
    const unsigned following = (best + 1) % 4, previous = (best + 3) % 4;
    if ((at_end >> best & at_start >> following & 1) != 0) others &= ~(1 << following);
    if ((at_start >> best & at_end >> previous & 1) != 0) others &= ~(1 << previous);
    return others == 0 ? int(best) : -1;
  }
};

template <class T>
std::optional<ClosestPoint<T>> filtered_foot_on(const Rectangle<T>& r, const Vec3<T>& point, int edge) {
  const std::array<Vec3<T>, 4> v = corners(r);
  return filtered_foot(v[std::size_t(edge)], v[std::size_t(edge + 1) % 4], point);
}

/// Filter: the closest point of the perimeter, or nullopt.
template <class T>
std::optional<ClosestPoint<T>> filtered_closest_on_perimeter(const Rectangle<T>& r, const Vec3<T>& point) {
  const EdgesAndPoint<T> edges(r, point);
  if (!edges.in_range) return std::nullopt;
  const int edge = edges.certainly_nearest();
  return edge < 0 ? std::nullopt : filtered_foot_on(r, point, edge);
}

/// Filter: the foot of a point on the plane through three corners, or nullopt. It may lie anywhere in the plane.
///
/// Let w be the vector from the first corner to the point, n the cross product of the two edges, and q = |a| |b| / |n|,
/// with |x| the sum of the magnitudes for the edges a and b. n has an error of 4 q u of its length, which turns it, and
/// so moves the foot by at most 8 q u |w|. The rounding of the product with w, of the quotient and of the step adds 14
/// u |w|, and the last sum 1 u of itself. So the foot has an error of less than 22 q u |w| and 1 u of itself.
template <class T>
std::optional<ClosestPoint<T>> filtered_foot_on_plane(const Vec3<T>& v0, const Vec3<T>& v1, const Vec3<T>& v2,
                                                      const Vec3<T>& point) {
  if constexpr (has_wider<T>) {
    using W = Wider<T>;
    const Vec3<W> a = in_wider(v1) - in_wider(v0), b = in_wider(v2) - in_wider(v1), w = in_wider(point) - in_wider(v0);
    const Vec3<W> n = Plain::cross(a, b);
    const W length2 = Plain::dot(n, n), step = Plain::dot(n, w) / length2;
    const Vec3<T> place = rounded_to<T>(in_wider(point) - n * step);
    const double size = double(magnitudes(a)) * double(magnitudes(b)) * double(magnitudes(w));
    const double most = double(half_ulp<T> / 64) * double(largest_magnitude(place));
    if (size * size <= double(length2) * (most * most)) return ClosestPoint<T>{place};
  }
  return std::nullopt;
}

/// Filter: the closest point of a rectangle, which is that of two triangles with a common edge, the diagonal; or
/// nullopt.
///
/// A cross product of two edges, or of an edge and a vector to the point, has an error of 4 u S^2, and the product of
/// two of them one of 11 u S^4. Its sign tells on which side of an edge the foot on a triangle's plane lies. Where the
/// foot certainly lies in one triangle and outside of the other, it is compared with the edges of the other: squared
/// distances times |n|^2 have errors of 46 u S^6 from an edge and of 18 u S^6 from the plane.
template <class T>
std::optional<ClosestPoint<T>> filtered_closest_point(const Rectangle<T>& r, const Vec3<T>& point) {
  using L = Lanes<double>;
  const EdgesAndPoint<T> edges(r, point);
  if (!edges.in_range) return std::nullopt;
  const Columns<double> normals =
      cross(edges.along, EdgesAndPoint<T>::next(edges.along));  // 0: of v0 v1 v2, 2: v2 v3 v0
  const auto of_triangles = [](const L& a) COLLIDE_INLINE { return a.template shuffled<0, 0, 2, 2>(); };
  const Columns<double> n{of_triangles(normals.x), of_triangles(normals.y), of_triangles(normals.z)};
  const double size2 = edges.size * edges.size, bound = 0x1p-49 * size2 * size2;
  const L sides = dot(n, cross(edges.along, edges.to_point));
  const int inner = (L::splat(bound) < sides).bits(), outer = (sides < L::splat(-bound)).bits();
  const Vec3<double> diagonal = in_double(r.v2) - in_double(r.v0), w = in_double(point) - in_double(r.v0);
  const L across = wide_lanes(Plain::cross(diagonal, w));
  const std::array<double, 4> beside = to_array(dot(n, splat_columns(across)));
  const bool inside1 = (inner & 3) == 3 && beside[0] < -bound, inside2 = (inner & 12) == 12 && beside[2] > bound;
  const bool outside1 = (outer & 3) != 0 || beside[0] > bound, outside2 = (outer & 12) != 0 || beside[2] < -bound;
  if ((inside1 && outside2) || (inside2 && outside1)) {
    const L height = dot(n, edges.to_point);
    const L excess =
        edges.distance2 * dot(n, n).template shuffled<2, 2, 0, 0>() - (height * height).template shuffled<2, 2, 0, 0>();
    const int farther = (L::splat(0x1p-46 * size2 * size2 * size2) < excess).bits();
    if (inside1) return (farther & 12) == 12 ? filtered_foot_on_plane(r.v0, r.v1, r.v2, point) : std::nullopt;
    return (farther & 3) == 3 ? filtered_foot_on_plane(r.v2, r.v3, r.v0, point) : std::nullopt;
  }
  if (!(outside1 && outside2)) return std::nullopt;
  const int edge = edges.certainly_nearest();
  if (edge < 0) return std::nullopt;
  // The diagonal is farther, or its foot is certainly the same corner.
  const double length2 = Plain::dot(diagonal, diagonal), product = Plain::dot(w, diagonal);
  const double share = length2 > 0 ? clamped(product / length2, 0.0, 1.0) : 0.0, bound2 = 0x1p-48 * size2;
  const Vec3<double> away = w - diagonal * share;
  const double least = to_array(edges.distance2)[std::size_t(edge)];
  const int is_at_v0 = (edges.at_start & 1) | (edges.at_end & 8), is_at_v2 = (edges.at_end & 2) | (edges.at_start & 4);
  const bool shares_corner =
      (product < -bound2 && (is_at_v0 >> edge & 1) != 0) || (product - length2 > bound2 && (is_at_v2 >> edge & 1) != 0);
  if (!(Plain::dot(away, away) > least + edges.bound_of_distance2() || shares_corner)) return std::nullopt;
  return filtered_foot_on(r, point, edge);
}

}  // namespace collide::detail

#endif

#include <collide/detail/strict_end.hpp>
