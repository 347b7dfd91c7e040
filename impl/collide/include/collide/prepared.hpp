/// Prepared inputs: a shape together with values that a query derives from it, computed once for many calls.
///
/// All follow one convention: `prepare_SHAPE<Tier>(shape)` returns a `PreparedSHAPE`, which replaces the shape among
/// the arguments of a query. Use it in the tier that prepared it. Preparation saves time and does not change the answer
/// in real numbers. The prepared form of a pair of boxes is BoxBoxInfo, made by box_box_info.
#pragma once

#include <collide/detail/contact.hpp>
#include <collide/detail/edges.hpp>
#include <collide/detail/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

/// A segment with its unit direction (zero for a point) and its length; made by `prepare_segment`.
template <class T>
struct PreparedSegment {
  Segment<T> segment{};
  Vec3<T> direction{};
  T length{};
};

template <class Tier = Fast, class T>
[[nodiscard]] PreparedSegment<T> prepare_segment(const Segment<T>& segment) noexcept(Tier::never_throws) {
  const Vec3<T> along = segment.v1 - segment.v0;
  return {segment, unit<Tier>(along), length(components(along))};
}

/// A triangle with the unit directions (zero for an edge of length 0) and the lengths of its edges; made by
/// `prepare_triangle_edges`.
template <class T>
struct PreparedTriangleEdges {
  Triangle<T> triangle{};
  std::array<Vec3<T>, 3> direction{};  ///< direction of edge i, from v[i] to v[(i + 1) % 3]
  std::array<T, 3> length{};
};

template <class Tier = Fast, class T>
[[nodiscard]] PreparedTriangleEdges<T> prepare_triangle_edges(const Triangle<T>& triangle) noexcept(
    Tier::never_throws) {
  const std::array<Vec3<T>, 3> v = detail::corners(triangle);
  PreparedTriangleEdges<T> edges{triangle, {}, {}};
  for (int i = 0; i < 3; ++i) {
    const Vec3<T> along = v[(i + 1) % 3] - v[i];
    edges.direction[i] = unit<Tier>(along);
    edges.length[i] = length(components(along));
  }
  return edges;
}

/// A triangle with the edges and the normal that `moving_point_triangle_prepared` needs; made by `prepare_triangle`.
template <class T>
struct PreparedTriangle {
  Triangle<T> triangle{};
  Vec3<T> edge1{}, edge2{};  ///< from v0 to v1 and to v2
  Vec3<T> normal{};          ///< edge1 x edge2; its length is twice the area
  Vec3<T> unit_normal{};     ///< normal / |normal|; zero for a triangle without area
};

template <class Tier = Fast, class T>
[[nodiscard]] PreparedTriangle<T> prepare_triangle(const Triangle<T>& triangle) noexcept(Tier::never_throws) {
  const Vec3<T> edge1 = triangle.v1 - triangle.v0, edge2 = triangle.v2 - triangle.v0;
  const Vec3<T> normal = detail::normal_of<Tier>(edge1, edge2);
  return {triangle, edge1, edge2, normal, unit<Tier>(normal)};
}

/// A ray with the inverse of its direction, for tests against many boxes; made by `prepare_ray`. A ray with a number
/// that is not finite is stored with its origin at -infinity, so that it hits nothing.
template <class T>
struct PreparedRay {
  Ray<T> ray{};
  Vec3<T> inverse{};  ///< 1 / direction in each coordinate, clamped to finite numbers; +infinity for 0
};

template <class Tier = Fast, class T>
[[nodiscard]] PreparedRay<T> prepare_ray(const Ray<T>& ray) noexcept(Tier::never_throws) {
  if constexpr (MachineNumber<T>) {
    using limits = std::numeric_limits<T>;
    constexpr T infinity = limits::infinity();
    if (!all_finite(ray)) return {{{-infinity, -infinity, -infinity}, {T(1), T(1), T(1)}}, {T(1), T(1), T(1)}};
    const auto inverse = [](T x) { return x == T(0) ? infinity : clamped(T(1) / x, -limits::max(), limits::max()); };
    return {ray, {inverse(ray.direction.x), inverse(ray.direction.y), inverse(ray.direction.z)}};
  } else {
    const auto inverse = [](const T& x) { return x == T(0) ? T(0) : T(T(1) / x); };  // the 0 is never used
    return {ray, {inverse(ray.direction.x), inverse(ray.direction.y), inverse(ray.direction.z)}};
  }
}

/// An axis-aligned box for tests against many rays; made by `prepare_aabox`.
template <class T>
struct PreparedAABox {
  AABox<T> aabox{};  ///< if a number is not finite, all six are +infinity, so that no ray hits the box
};

template <class Tier = Fast, class T>
[[nodiscard]] PreparedAABox<T> prepare_aabox(const AABox<T>& aabox) noexcept(Tier::never_throws) {
  if constexpr (MachineNumber<T>) {
    constexpr T infinity = std::numeric_limits<T>::infinity();
    if (!all_finite(aabox)) return {{{infinity, infinity, infinity}, {infinity, infinity, infinity}}};
  }
  return {aabox};
}

}  // namespace collide

#include <collide/detail/strict_end.hpp>
