/// Prepared inputs: a shape with values that a query derives from it, computed once for many calls.
///
/// One convention holds for all: `prepare_SHAPE<Tier>(shape)` returns a `PreparedSHAPE`, which takes the place of the
/// shape among the arguments of the query, in the tier that prepared it. A prepared shape saves time and never changes
/// the answer in real numbers. Of a pair of boxes the prepared form is BoxBoxInfo, by box_box_info.
#pragma once

#include <collide/detail/contact.hpp>
#include <collide/detail/edges.hpp>
#include <collide/detail/frame.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

/// A segment with its unit direction (zero for a point) and its length: made once, asked often.
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

/// A triangle with the unit directions (zero for a point) and lengths of its edges: made once, asked often.
template <class T>
struct PreparedTriangleEdges {
  Triangle<T> triangle{};
  std::array<Vec3<T>, 3> direction{};  ///< of edge i, from v[i] to v[(i + 1) % 3]
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

/// A triangle with what `moving_point_triangle_prepared` needs of it; made by `prepare_triangle`.
template <class T>
struct PreparedTriangle {
  Triangle<T> triangle{};
  Vec3<T> edge1{}, edge2{};  ///< from v0 to v1 and to v2
  Vec3<T> normal{};          ///< edge1 x edge2, as long as twice the area
  Vec3<T> unit_normal{};     ///< normal / |normal|; zero for a triangle without area
};

template <class Tier = Fast, class T>
[[nodiscard]] PreparedTriangle<T> prepare_triangle(const Triangle<T>& triangle) noexcept(Tier::never_throws) {
  const Vec3<T> edge1 = triangle.v1 - triangle.v0, edge2 = triangle.v2 - triangle.v0;
  const Vec3<T> normal = detail::normal_of<Tier>(edge1, edge2);
  return {triangle, edge1, edge2, normal, unit<Tier>(normal)};
}

/// A ray that is asked about many boxes; made by `prepare_ray`. One that is not finite starts at -infinity: it meets
/// nothing.
template <class T>
struct PreparedRay {
  Ray<T> ray{};
  Vec3<T> inverse{};  ///< 1 / direction in each coordinate, at most the largest number; +infinity for 0
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
    const auto inverse = [](const T& x) { return x == T(0) ? T(0) : T(T(1) / x); };  // 0 is not used
    return {ray, {inverse(ray.direction.x), inverse(ray.direction.y), inverse(ray.direction.z)}};
  }
}

/// A box that is asked about many rays; made by `prepare_aabox`.
template <class T>
struct PreparedAABox {
  AABox<T> aabox{};  ///< its six numbers +infinity where one of them is not finite: nothing meets it
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
