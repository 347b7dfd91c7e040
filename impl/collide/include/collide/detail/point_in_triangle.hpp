/// The kernel of point_in_triangle (collide/point_in_triangle.hpp).
#pragma once

#include <array>
#include <limits>
#include <optional>

#include <collide/answers.hpp>
#include <collide/detail/edges.hpp>
#include <collide/detail/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// The axis 0..2 of the component of largest magnitude; the first of equal ones.
template <class T>
int largest_component(const Vec3<T>& v) {
  using detail::abs;
  const T x = abs(v.x), y = abs(v.y), z = abs(v.z);
  if (x >= y && x >= z) return 0;
  return y >= z ? 1 : 2;
}

/// `v` projected along the axis: that component is set to zero.
template <class T>
Vec3<T> projected_along(int axis, const Vec3<T>& v) {
  return {axis == 0 ? T(0) : v.x, axis == 1 ? T(0) : v.y, axis == 2 ? T(0) : v.z};
}

/// Whether the point lies in the closed triangle, both projected along the axis. A triangle without area is a segment
/// or a point. The point must lie on one side of all three edges and within the bounds of the triangle. The bounds
/// reject points on the line of a triangle without area and, after rounding, points beyond the tip of a thin one.
///
/// Two triangles that share an edge compute the same number for it, with opposite signs.
template <class Tier, class T>
bool is_inside(const std::array<Vec3<T>, 3>& v, int axis, const Vec3<T>& point) {
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  std::array<std::array<T, 3>, 3> from;
  for (int i = 0; i < 3; ++i) from[i] = components(v[i] - point);
  for (const int k : {a, b}) {
    if (!(smaller(smaller(from[0][k], from[1][k]), from[2][k]) <= T(0))) return false;
    if (!(larger(larger(from[0][k], from[1][k]), from[2][k]) >= T(0))) return false;
  }
  bool left = true, right = true;
  for (int i = 0; i < 3; ++i) {
    const std::array<T, 3>&start = from[i], &end = from[(i + 1) % 3];
    const T orientation = Tier::difference_of_products(start[a], end[b], start[b], end[a]);
    left = left && orientation >= T(0);
    right = right && orientation <= T(0);
  }
  if constexpr (MachineNumber<T>) {  // the coordinate along the axis must be finite too
    if (!(detail::abs(from[0][axis] + from[1][axis] + from[2][axis]) <= std::numeric_limits<T>::max())) return false;
  }
  return left || right;
}

/// Filter in the next wider type: the certain answer, or nullopt. The weights are the edge functions divided by their
/// sum. Gives nullopt if the point may lie on the line of an edge, the triangle has no area, or an input is not finite.
///
/// The wider type neither overflows nor underflows here. An edge function has an error of 4 u of the sum of its terms'
/// magnitudes, with u the wider type's unit roundoff. The weights have an error of 11 u of the magnitudes of all terms,
/// divided by the sum of the edge functions. The filter requires 16 u of these to be at most a quarter of the scalar's
/// epsilon, one unit in the last place of the largest weight.
template <class T>
std::optional<Containment<T>> filtered_containment(const Triangle<T>& triangle, int axis, const Vec3<T>& point) {
  if constexpr (has_wider<T>) {
    using W = Wider<T>;
    constexpr W u = std::numeric_limits<W>::epsilon() / 2;
    const std::size_t a = std::size_t(axis + 1) % 3, b = std::size_t(axis + 2) % 3;
    const std::array<T, 3> at = components(point);
    std::array<W, 3> from_a, from_b;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::array<T, 3> corner = components(corners(triangle)[i]);
      from_a[i] = W(corner[a]) - W(at[a]), from_b[i] = W(corner[b]) - W(at[b]);
    }
    std::array<W, 3> side;
    W magnitudes = 0;
    int left = 0, right = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = (i + 1) % 3;
      const W p = from_a[i] * from_b[next], q = from_a[next] * from_b[i], size = detail::abs(p) + detail::abs(q);
      side[i] = p - q;
      magnitudes += size;
      left += int(side[i] > 8 * u * size), right += int(-side[i] > 8 * u * size);
    }
    if (left > 0 && right > 0) return Containment<T>{};
    if (!(left == 3 || right == 3) || !all_finite(triangle, point)) return std::nullopt;
    const W sum = side[0] + side[1] + side[2];
    if (!(16 * u * magnitudes <= detail::abs(sum) * (std::numeric_limits<T>::epsilon() / 4))) return std::nullopt;
    return Containment<T>{{T(side[1] / sum), T(side[2] / sum), T(side[0] / sum)}, true};
  }
  return std::nullopt;
}

}  // namespace detail

COLLIDE_COMPILED(point_in_triangle)

namespace kernels {

template <class Tier, class T>
inline Containment<T> point_in_triangle(const Triangle<T>& triangle, const Vec3<T>& normal, int axis,
                                        const Vec3<T>& point) {
  if constexpr (Tier::template lifts<T>) {
    if constexpr (uses_filter<Tier, T>) {
      if (detail::is_finite(normal)) {
        const int along = axis >= 0 && axis <= 2 ? axis : detail::largest_component(normal);
        if (const auto answer = detail::filtered_containment(triangle, along, point))
          return Tier::decided_by_filter(*answer);
      }
    }
    return COLLIDE_LIFTED(point_in_triangle, triangle, normal, axis, point);
  } else {
    if constexpr (MachineNumber<T>) {
      if (!detail::is_finite(normal)) return {};
    }
    const int along = axis >= 0 && axis <= 2 ? axis : detail::largest_component(normal);
    std::array<Vec3<T>, 3> v = detail::corners(triangle);
    if (!detail::is_inside<Tier>(v, along, point)) return {};

    for (Vec3<T>& x : v) x = detail::projected_along(along, x);
    const Vec3<T> p = detail::projected_along(along, point);
    const detail::FaceFoot<T> face = detail::foot_on_face<Tier>(v[1] - v[0], v[2] - v[0], p - v[0]);
    if (face.inside) {
      const T rest = positive_part(T(1) - face.base_weight - face.apex_weight);
      return {{rest, face.base_weight, face.apex_weight}, true};
    }
    // No area, or on an edge up to rounding: the weights of the ends of the closest edge.
    std::array<T, 3> weights{};
    T nearest(0);
    for (int i = 0; i < 3; ++i) {
      const detail::EdgeFoot<T> foot = detail::foot_on_edge<Tier>(v[i], v[(i + 1) % 3], p);
      const Vec3<T> away = p - v[i] - foot.from_start;
      const T distance2 = Tier::dot(away, away);
      if (i > 0 && !(distance2 < nearest)) continue;
      nearest = distance2;
      weights = {};
      weights[i] = T(1) - foot.share;
      weights[(i + 1) % 3] = foot.share;
    }
    return {{weights[0], weights[1], weights[2]}, true};
  }
}

}  // namespace kernels
}  // namespace collide

#include <collide/detail/strict_end.hpp>
