/// The kernel of aabox_triangle_overlap (collide/aabox_triangle_overlap.hpp).
#pragma once

#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/edges.hpp>
#include <collide/detail/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

#if defined(COLLIDE_LANES)

namespace detail {

/// Filter in doubles: whether a triangle a, b, c meets the box around the origin, unless a coordinate axis separates
/// them; nullopt if rounding may change the decision. Each coordinate of a corner and each half extent has an error of
/// at most `error`; the sum of the magnitudes of each of them is at most `size`.
///
/// Let u = 2^-53, e the error, S the size. A coordinate of an edge has an error of 2 e + 2 u S. Along a cross product,
/// a corner and the box's projected radius then have an error of 4 e S + 8 u S^2 each, so their difference has an error
/// of less than 32 S (e + u S). The normal has an error of 8 e S + 20 u S^2; along it a corner and the radius have an
/// error of 20 e S^2 + 32 u S^3 each, so their difference has an error of less than 128 S^2 (e + u S).
inline std::optional<bool> filtered_overlap_at_origin(const Lanes<double>& half, const Lanes<double>& a,
                                                      const Lanes<double>& b, const Lanes<double>& c, double size,
                                                      double error) {
  using L = Lanes<double>;
  const L zero = L::splat(0.0), half1 = yzx(half), half2 = zxy(half);
  const double unsure = error + 0x1p-53 * size, bound2 = 32 * size * unsure, bound3 = 128 * size * size * unsure;
  // The distance between the interval [p, q] (in either order) and the box's interval [-reach, reach]; negative if they
  // overlap.
  const auto gap = [&](const L& p, const L& q, const L& reach)
                       COLLIDE_INLINE { return larger(smaller(p, q), zero - larger(p, q)) - reach; };
  // The gaps along the cross products of an edge and the coordinate axes. Both ends of the edge project to the same
  // number.
  const auto gaps = [&](const L& edge, const L& start, const L& apex) COLLIDE_INLINE {
    const L size_of = absolute(edge);
    return gap(cross(edge, start), cross(edge, apex), half1 * zxy(size_of) + half2 * yzx(size_of));
  };
  const L ab = b - a, gaps_ab = gaps(ab, a, c), gaps_bc = gaps(c - b, b, a), gaps_ca = gaps(a - c, c, b);
  const L n = cross(ab, c - a), of_plane = sum_of_three(n * a), reach = sum_of_three(absolute(n) * half);
  const double plane_gap = detail::abs(of_plane.first()) - reach.first();
  const L largest = larger(larger(gaps_ab, gaps_bc), gaps_ca), limit = L::splat(bound2);
  if (any_of_three(limit < largest) || plane_gap > bound3) return false;
  if (all_three(largest < zero - limit) && plane_gap < -bound3) return true;
  return std::nullopt;
}

/// Filter in doubles for a box that is aligned with the axes. The comparisons along the coordinate axes do not round.
/// Relative to the box's center a coordinate has an error of 3 u S.
template <class T>
std::optional<bool> filtered_overlap(const AABox<T>& box, const Triangle<T>& triangle) {
  using L = Lanes<double>;
  const L low = wide_lanes(box.min), high = wide_lanes(box.max), half_of = L::splat(0.5);
  const L v0 = wide_lanes(triangle.v0), v1 = wide_lanes(triangle.v1), v2 = wide_lanes(triangle.v2);
  const double size = sum_of_three(absolute(low) + absolute(high) + absolute(v0) + absolute(v1) + absolute(v2)).first();
  if (!(size >= 0x1p-250 && size <= 0x1p250)) return std::nullopt;
  if (any_of_three((high < smaller(smaller(v0, v1), v2)) | (larger(larger(v0, v1), v2) < low))) return false;
  const L center = (low + high) * half_of, half = (high - low) * half_of;
  return filtered_overlap_at_origin(half, v0 - center, v1 - center, v2 - center, size, 0x1p-51 * size);
}
}  // namespace detail

#endif

COLLIDE_COMPILED(aabox_triangle_overlap)

namespace kernels {

template <class Tier, class T>
inline Decision<T> aabox_triangle_overlap(const AABox<T>& box, const Triangle<T>& triangle) {
#if defined(COLLIDE_LANES)
  if constexpr (in_lanes<Tier, T> || uses_filter<Tier, T>) {
    if (const auto decided = detail::filtered_overlap(box, triangle)) {
      if constexpr (uses_filter<Tier, T>) return Tier::decided_by_filter(Decision<T>{*decided});
      return {*decided};
    }
  }
#endif
  if constexpr (Tier::template lifts<T>) {
    return COLLIDE_LIFTED(aabox_triangle_overlap, box, triangle);
  } else {
    if constexpr (MachineNumber<T>) {
      if (!detail::is_finite(box.min + box.max + triangle.v0 + triangle.v1 + triangle.v2)) return {false};
    }
    using Three = std::array<T, 3>;
    const std::array<Three, 3> v{components(triangle.v0), components(triangle.v1), components(triangle.v2)};
    const Three low = components(box.min), high = components(box.max);
    for (int k = 0; k < 3; ++k) {
      if (!(smaller(smaller(v[0][k], v[1][k]), v[2][k]) <= high[k])) return {false};
      if (!(larger(larger(v[0][k], v[1][k]), v[2][k]) >= low[k])) return {false};
    }

    // The cross product of coordinate axis k and an edge: projected along axis k, the box against the line through the
    // edge.
    for (int i = 0; i < 3; ++i) {
      const Three &start = v[i], &end = v[(i + 1) % 3], &apex = v[(i + 2) % 3];
      Three edge, to_low, to_high, to_apex;
      for (int k = 0; k < 3; ++k) {
        edge[k] = end[k] - start[k];
        to_low[k] = low[k] - start[k];
        to_high[k] = high[k] - start[k];
        to_apex[k] = apex[k] - start[k];
      }
      for (int k = 0; k < 3; ++k) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        const T b1 = edge[a] * to_low[b], b2 = edge[a] * to_high[b];
        const T a1 = edge[b] * to_low[a], a2 = edge[b] * to_high[a];
        const T of_apex = Tier::difference_of_products(edge[a], to_apex[b], edge[b], to_apex[a]);
        if (!(smaller(b1, b2) - larger(a1, a2) <= positive_part(of_apex))) return {false};
        if (!(larger(b1, b2) - smaller(a1, a2) >= smaller(of_apex, T(0)))) return {false};
      }
    }

    // The triangle's plane. Its normal is multiplied by the squared length of an edge, so nothing is divided.
    const Vec3<T> base = triangle.v1 - triangle.v0, apex = triangle.v2 - triangle.v0;
    const Vec3<T> height = apex * Tier::dot(base, base) - base * Tier::dot(apex, base);
    const Three normal = components(Tier::cross(base, height));
    T least(0), most(0);
    for (int k = 0; k < 3; ++k) {
      const T to_low = normal[k] * (low[k] - v[0][k]), to_high = normal[k] * (high[k] - v[0][k]);
      least = least + smaller(to_low, to_high);
      most = most + larger(to_low, to_high);
    }
    return {least <= T(0) && most >= T(0)};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
