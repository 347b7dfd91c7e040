/// The kernels of the overlap of every two of a point, a sphere, a segment and a capsule: their cores are points and
/// segments, so machine numbers compare a shortest way between the cores with the sum of the radii. Other numbers look
/// for a direction that separates (detail/overlaps.hpp): that needs no division and no case distinction.
#pragma once

#include <optional>

#include <collide/detail/nearest_points.hpp>
#include <collide/detail/overlaps.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// A sphere around the point, and a capsule around the segment, in numbers of N.
template <class N, class T>
Sphere<N> rounded(const Vec3<T>& point) {
  return {{N(point.x), N(point.y), N(point.z)}, N(0)};
}
template <class N, class T>
Sphere<N> rounded(const Sphere<T>& sphere) {
  return {rounded<N>(sphere.center).center, N(sphere.radius)};
}
template <class N, class T>
Capsule<N> rounded(const Segment<T>& segment) {
  return {rounded<N>(segment.v0).center, rounded<N>(segment.v1).center, N(0)};
}
template <class N, class T>
Capsule<N> rounded(const Capsule<T>& capsule) {
  return {rounded<N>(capsule.p0).center, rounded<N>(capsule.p1).center, N(capsule.radius)};
}

/// The sum of the magnitudes of the coordinates.
template <class T>
T extent_of(const Vec3<T>& v) {
  return detail::abs(v.x) + detail::abs(v.y) + detail::abs(v.z);
}

/// Of two rounded shapes relative to a vertex of the first: a shortest way between the cores, the gap of the cores
/// along it, times its length, and the sum of the magnitudes of all coordinates of vertices and edges.
template <class T>
struct MeasuredWay {
  Vec3<T> way;
  T gap, extent;
};
template <class T>
MeasuredWay<T> way_between(const Sphere<T>& sphere, const Capsule<T>& capsule) {
  const Axis<T> axis(capsule.p0, capsule.p1, sphere.center);
  const Vec3<T> end = capsule.p1 - sphere.center, way = shortest_way<Plain>(Vec3<T>{}, axis);
  return {way, smaller(Plain::dot(way, axis.start), Plain::dot(way, end)), extent_of(axis.start) + extent_of(end)};
}
template <class T>
MeasuredWay<T> way_between(const Capsule<T>& capsule1, const Capsule<T>& capsule2) {
  const Axis<T> first(capsule1.p0, capsule1.p1, capsule1.p0), second(capsule2.p0, capsule2.p1, capsule1.p0);
  const Vec3<T> end1 = capsule1.p1 - capsule1.p0, end2 = capsule2.p1 - capsule1.p0;
  const Vec3<T> way = shortest_way<Plain>(first, second);
  return {way, smaller(Plain::dot(way, second.start), Plain::dot(way, end2)) - larger(T(0), Plain::dot(way, end1)),
          extent_of(end1) + extent_of(second.start) + extent_of(end2)};
}

/// Filter in doubles: whether two rounded shapes meet; nullopt if rounding may change the decision.
///
/// Let u = 2^-53 and S the sum of the magnitudes of the coordinates relative to a vertex. Each computed parameter is
/// that of a point of its segment, so the way is one between points of the cores, whatever the errors of the
/// parameters: it is at most 16 u S from the exact way between these points (an edge has an error of 2 u S, its product
/// with the parameter 2 u S more, twice; a start u S; two sums 2 u S each). Not longer than the radii: the shapes meet.
/// Along any direction n, a gap between the vertices has an error of 10 u S |n|: a coordinate u S, three products and
/// two sums 4 u S |n|, twice. If the gap exceeds the radii times |n|, the shapes are apart. A length, a product and the
/// sum of the radii add 8 u of the radii.
template <class A, class B>
std::optional<bool> filtered_overlap(const A& a, const B& b) {
  const double radii = a.radius + b.radius;
  const MeasuredWay<double> between = way_between(a, b);
  const double s = between.extent, error = 0x1p-48 * s, slack = 0x1p-49 * radii;
  if (!(s >= 0x1p-200 && s <= 0x1p200 && radii <= 0x1p200)) return std::nullopt;
  const double length2 = Plain::dot(between.way, between.way), sure = radii - slack - error;
  if (sure >= 0x1p-300 && length2 <= sure * sure) return true;
  if (length2 >= 0x1p-600 && between.gap > sqrt(length2) * (radii + slack + error)) return false;
  return std::nullopt;
}

}  // namespace detail

namespace kernels {

template <class Tier, MachineNumber T>
inline Decision<T> overlap(const Sphere<T>& sphere, const Capsule<T>& capsule) {
  const detail::Axis<T> axis(capsule.p0, capsule.p1, sphere.center);
  const Vec3<T> way = detail::shortest_way<Tier>(Vec3<T>{}, axis);
  return {Tier::beyond_radius(way, T(sphere.radius + capsule.radius)) <= T(0)};
}
template <class Tier, MachineNumber T>
inline Decision<T> overlap(const Capsule<T>& capsule1, const Capsule<T>& capsule2) {
  const detail::Axis<T> first(capsule1.p0, capsule1.p1, capsule1.p0), second(capsule2.p0, capsule2.p1, capsule1.p0);
  const Vec3<T> way = detail::shortest_way<Tier>(first, second);
  return {Tier::beyond_radius(way, T(capsule1.radius + capsule2.radius)) <= T(0)};
}

/// The kernel of every overlap of this file.
template <class Tier, class T, class A, class B>
inline Decision<T> overlap_of_axes(const A& a, const B& b) {
  if constexpr (MachineNumber<T>) {
    return overlap<Tier>(detail::rounded<T>(a), detail::rounded<T>(b));
  } else {
    return overlap<Tier>(a, b);
  }
}

}  // namespace kernels
}  // namespace collide

// NOLINTBEGIN(bugprone-macro-parentheses): a type and a name that is declared have none

/// Defines the function `name` of two of these shapes, its contract and its kernel.
#define COLLIDE_OVERLAP_OF_AXES(name, First, first, Second, second)                                      \
  namespace kernels {                                                                                    \
  template <class Tier, class T>                                                                         \
  inline Decision<T> name(const First<T>& first, const Second<T>& second) {                              \
    if constexpr (uses_filter<Tier, T>) {                                                                \
      if (const auto decided =                                                                           \
              detail::filtered_overlap(detail::rounded<double>(first), detail::rounded<double>(second))) \
        return Tier::decided_by_filter(Decision<T>{*decided});                                           \
    }                                                                                                    \
    if constexpr (Tier::template lifts<T>) {                                                             \
      return COLLIDE_LIFTED(name, first, second);                                                        \
    } else {                                                                                             \
      return overlap_of_axes<Tier, T>(first, second);                                                    \
    }                                                                                                    \
  }                                                                                                      \
  }                                                                                                      \
  COLLIDE_OVERLAP_FUNCTION(name, First, first, Second, second)

// NOLINTEND(bugprone-macro-parentheses)

#include <collide/detail/strict_end.hpp>
