/// The kernels of the overlap and the signed distance of a rounded polytope and a half-space.
///
/// The half-space's normal alone separates the two, and a vertex of the core that is least far along it is the deepest
/// one. So nothing is searched but that vertex: where two of them are equally far, each is right.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/frame.hpp>
#include <collide/detail/overlaps.hpp>
#include <collide/detail/wide_filters.hpp>
#include <collide/shapes.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// A vertex of the shape's core that is least far along a direction.
template <class Tier, class T>
Vec3<T> least_along(const Vec3<T>&, const Vec3<T>& point) {
  return point;
}
template <class Tier, class T>
Vec3<T> least_along(const Vec3<T>&, const Sphere<T>& sphere) {
  return sphere.center;
}
template <class Tier, class T>
Vec3<T> least_along(const Vec3<T>& direction, const Segment<T>& segment) {
  return Tier::dot(direction, segment.v1 - segment.v0) < T(0) ? segment.v1 : segment.v0;
}
template <class Tier, class T>
Vec3<T> least_along(const Vec3<T>& direction, const Capsule<T>& capsule) {
  return least_along<Tier>(direction, Segment<T>{capsule.p0, capsule.p1});
}
template <class Tier, class T>
Vec3<T> least_along(const Vec3<T>& direction, const Triangle<T>& triangle) {
  return least_along<Tier>(direction,
                           Segment<T>{least_along<Tier>(direction, Segment<T>{triangle.v0, triangle.v1}), triangle.v2});
}
template <class Tier, class T>
Vec3<T> least_along(const Vec3<T>& direction, const Box<T>& box) {
  const Axes<T> axes = axes_of(box.orientation);
  const std::array<T, 3> slopes = into_frame<Tier>(axes, direction), half = components(box.half);
  Vec3<T> corner = box.center;
  for (int i = 0; i < 3; ++i) {
    const Vec3<T> side = axes[i] * half[i];
    corner = slopes[i] > T(0) ? corner - side : corner + side;
  }
  return corner;
}

/// How far a point is above the plane of a half-space, times the length of its normal.
template <class Tier, class T>
T height_above(const HalfSpace<T>& halfspace, const Vec3<T>& point) {
  return Tier::dot(halfspace.normal, point) + halfspace.offset;
}

template <class T, class Shape>
T radius_of(const Shape& shape) {
  if constexpr (requires { shape.radius; }) {
    return shape.radius;
  } else {
    return T(0);
  }
}

/// A vertex of a shape, in W, that certainly is less far along a direction than every other, and the error of its
/// coordinates in units of the error of an operation.
template <class W>
struct CertainVertex {
  Vec3<W> at;
  double error = 0;
};

/// Whether the first point is certainly less far along a direction: the product has an error of 5 u of its terms, with
/// u = 2^-53, half of the bound.
inline bool is_surely_before(const Vec3<double>& direction, const Vec3<double>& first, const Vec3<double>& last) {
  const Vec3<double> way = last - first;
  const double terms = abs(direction.x * way.x) + abs(direction.y * way.y) + abs(direction.z * way.z);
  return Plain::dot(direction, way) > 0x1p-49 * terms + 4 * std::numeric_limits<double>::min();
}
template <class W, class T, std::size_t n>
std::optional<CertainVertex<W>> least_of(const Vec3<T>& direction, const std::array<Vec3<T>, n>& vertices) {
  const Vec3<double> along = in_double(direction);
  for (std::size_t i = 0; i < n; ++i) {
    bool is_least = true;
    for (std::size_t k = 0; k < n; ++k) {
      if (k != i) is_least = is_least && is_surely_before(along, in_double(vertices[i]), in_double(vertices[k]));
    }
    if (is_least) return CertainVertex<W>{in_wider(vertices[i])};
  }
  return std::nullopt;
}
template <class W, class T>
std::optional<CertainVertex<W>> certain_least(const Vec3<T>&, const Vec3<T>& point) {
  return CertainVertex<W>{in_wider(point)};
}
template <class W, class T>
std::optional<CertainVertex<W>> certain_least(const Vec3<T>&, const Sphere<T>& sphere) {
  return CertainVertex<W>{in_wider(sphere.center)};
}
template <class W, class T>
std::optional<CertainVertex<W>> certain_least(const Vec3<T>& direction, const Segment<T>& segment) {
  return least_of<W>(direction, std::array{segment.v0, segment.v1});
}
template <class W, class T>
std::optional<CertainVertex<W>> certain_least(const Vec3<T>& direction, const Capsule<T>& capsule) {
  return least_of<W>(direction, std::array{capsule.p0, capsule.p1});
}
template <class W, class T>
std::optional<CertainVertex<W>> certain_least(const Vec3<T>& direction, const Triangle<T>& triangle) {
  return least_of<W>(direction, std::array{triangle.v0, triangle.v1, triangle.v2});
}
/// A number of the matrix has an error of 15 u, so an axis along the direction has one of 20 u of its numbers, and a
/// coordinate of a corner, a sum of four terms, 20 u of the half extents and 4 u of the center's.
template <class W, class T>
std::optional<CertainVertex<W>> certain_least(const Vec3<T>& direction, const Box<T>& box) {
  const auto& [x, y, z, w] = box.orientation;
  const Axes<W> axes = axes_of(Quaternion<W>{W(x), W(y), W(z), W(w)});
  const Vec3<W> along = in_wider(direction);
  const std::array<W, 3> slopes = into_frame<Plain>(axes, along), half = components(in_wider(box.half));
  const W doubt = magnitudes(along) * W(32 * std::numeric_limits<W>::epsilon());
  Vec3<W> corner = in_wider(box.center);
  const double error = double(W(20) * (half[0] + half[1] + half[2]) + W(4) * largest_magnitude(corner));
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(abs(slopes[k]) > doubt)) return std::nullopt;
    corner = corner + axes[k] * (slopes[k] > W(0) ? -half[k] : half[k]);
  }
  return CertainVertex<W>{corner, error};
}

/// Filter: the signed distance of a shape and a half-space, or nullopt where a number may not be accurate.
///
/// Errors are in units of u, that of an operation in the wider type. As in filtered_penetration of a sphere and a
/// plane, the distance has one of 9 of the sum of the radius and of the magnitudes of the terms of the height, by the
/// length of the normal, and sqrt(3) of that of the vertex. A point has that of the foot, 6 of the radius or the
/// height, and 1 of itself.
template <class A, class T>
std::optional<SignedDistance<T>> filtered_distance(const A& a, const HalfSpace<T>& halfspace) {
  if constexpr (has_wider<T>) {
    using W = Wider<T>;
    using limits = std::numeric_limits<T>;
    const auto vertex = certain_least<W>(halfspace.normal, a);
    if (!vertex) return std::nullopt;
    const Vec3<W>&at = vertex->at, n = in_wider(halfspace.normal);
    const W norm = sqrt(Plain::dot(n, n)), radius = W(radius_of<T>(a));
    if (!(norm > W(limits::min()))) return std::nullopt;
    const W height = (Plain::dot(n, at) + W(halfspace.offset)) / norm, distance = height - radius;
    const Vec3<W> normal = n * (W(-1) / norm), point1 = at + normal * radius, point2 = at + normal * height;
    const double terms =
        double((abs(n.x * at.x) + abs(n.y * at.y) + abs(n.z * at.z) + abs(W(halfspace.offset))) / norm);
    const double of_distance = 10 * (terms + double(radius)) + 2 * vertex->error;
    const double of_points = of_distance + vertex->error + 8 * double(radius + abs(height));
    return accurate_distance<T>(distance, normal, point1, point2, {of_distance, of_points, of_points});
  }
  return std::nullopt;
}

}  // namespace detail

namespace kernels {

template <class Tier, class A, class T>
inline Decision<T> overlap_with_half_space(const A& a, const HalfSpace<T>& halfspace) {
  const T height = detail::height_above<Tier>(halfspace, detail::least_along<Tier>(halfspace.normal, a));
  if constexpr (requires { a.radius; }) {
    if constexpr (MachineNumber<T>) {
      return {height <= a.radius * length(components(halfspace.normal))};
    } else {
      return {height <= T(0) || height * height <= a.radius * a.radius * Tier::dot(halfspace.normal, halfspace.normal)};
    }
  } else {
    return {height <= T(0)};
  }
}

template <class Tier, class A, class T>
inline SignedDistance<T> distance_to_half_space(const A& a, const HalfSpace<T>& halfspace) {
  const Vec3<T> deepest = detail::least_along<Tier>(halfspace.normal, a);
  const T norm = length(components(halfspace.normal)), radius = detail::radius_of<T>(a);
  const T height = detail::height_above<Tier>(halfspace, deepest) / norm;
  const Vec3<T> normal = -halfspace.normal / norm;
  Vec3<T> foot = deepest + normal * height;
  // The rounding errors of the first pass are those of a vertex that may be far away. No other vertex has a foot off
  // the plane, so a second pass removes them.
  if constexpr (MachineNumber<T>) foot = foot + normal * (detail::height_above<Tier>(halfspace, foot) / norm);
  return {height - radius, normal, deepest + normal * radius, foot};
}

}  // namespace kernels

namespace contracts {

/// First order. The dot product of a vertex has an error of 4 eps of |n| |vertex|, for which moving the vertex
/// accounts, and 1 eps of the offset. The choice of a vertex has one of 5 eps of each. The norm has an error of 3 eps
/// and the quotient 1 eps, for which changing n and the offset accounts. A sum or a product with the radius has an
/// error of 2 eps each. A corner of a box is a sum of four terms, of which three have 17 eps of a half extent: together
/// 64 more.
template <class Tier, class T>
constexpr Contract signed_distance_to_half_space(double backward) {
  return Tier::template contract<T>(
      {.backward = backward, .unit = 8, .lowest = lowest_for<T>(2), .highest = highest_for<T>(2)});
}

}  // namespace contracts
}  // namespace collide

// NOLINTBEGIN(bugprone-macro-parentheses): a type and a name that is declared have none

/// Defines the function `name` of a shape and a half-space, its kernel and its contract.
#define COLLIDE_OVERLAP_WITH_HALF_SPACE(backward, name, First, first, Second, second) \
  namespace kernels {                                                                 \
  template <class Tier, class T>                                                      \
  inline Decision<T> name(const First<T>& first, const Second<T>& second) {           \
    if constexpr (Tier::template lifts<T>) {                                          \
      return COLLIDE_LIFTED(name, first, second);                                     \
    } else {                                                                          \
      return overlap_with_half_space<Tier>(first, second);                            \
    }                                                                                 \
  }                                                                                   \
  }                                                                                   \
  COLLIDE_OVERLAP_FUNCTION_WITHIN(backward, name, First, first, Second, second)

#define COLLIDE_SIGNED_DISTANCE_TO_HALF_SPACE(backward, name, First, first, Second, second)                        \
  COLLIDE_COMPILED(name)                                                                                           \
  namespace kernels {                                                                                              \
  template <class Tier, class T>                                                                                   \
  inline SignedDistance<T> name(const First<T>& first, const Second<T>& second) {                                  \
    if constexpr (uses_filter<Tier, T>) {                                                                          \
      if (const auto decided = detail::filtered_distance(first, second)) return Tier::decided_by_filter(*decided); \
    }                                                                                                              \
    if constexpr (Tier::template lifts<T>) {                                                                       \
      return COLLIDE_LIFTED(name, first, second);                                                                  \
    } else {                                                                                                       \
      return distance_to_half_space<Tier>(first, second);                                                          \
    }                                                                                                              \
  }                                                                                                                \
  }                                                                                                                \
  namespace contracts {                                                                                            \
  template <class Tier = Fast, class T = double>                                                                   \
  constexpr Contract name() {                                                                                      \
    return signed_distance_to_half_space<Tier, T>(backward);                                                       \
  }                                                                                                                \
  }                                                                                                                \
  template <class Tier = Fast, class T>                                                                            \
  [[nodiscard]] inline SignedDistance<T> name(const First<T>& first,                                               \
                                              const Second<T>& second) noexcept(Tier::never_throws) {              \
    COLLIDE_ANSWER(name, TierOfNumbers<Tier>, first, second);                                                      \
  }

// NOLINTEND(bugprone-macro-parentheses)

#include <collide/detail/strict_end.hpp>
