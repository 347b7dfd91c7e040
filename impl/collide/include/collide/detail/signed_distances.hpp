/// The kernel of the signed distance of every two rounded polytopes whose cores are points or segments: a point, a
/// sphere, a segment, a capsule.
///
/// The signed distance of two cores is the greatest gap between them over all directions of length 1; the radii only
/// subtract. Of two such cores it is their distance. The nearest points of two segments follow from the place of the
/// second one that is nearest to the line of the first one, by at most two more projections.
///
/// Near a touch the way between two rounded points has no good direction. A right normal leads along the way and is
/// perpendicular to a segment that the way meets within. So of two normals, the direction of the way and one across
/// both segments, the kernel takes that which falls short of this by less. Source: Lumelsky, On fast computation of
/// distance between line segments, Information Processing Letters 21, 1985, for the projections. Eberly, Robust
/// Computation of Distance Between Line Segments, 2018, shows where the parameters of nearly parallel segments lose
/// their digits; here the part of the second segment across the first one is taken first.
#pragma once

#include <collide/detail/overlaps.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// A point of the first core, and the way from there to a point of the second one. Each is a vertex of its core, unless
/// it lies within a segment.
template <class T>
struct WayBetween {
  Vec3<T> from, way;
  bool from_within = false, to_within = false;
};

/// The part of `v` perpendicular to `direction`, not zero. The second pass removes what rounding left.
template <class Tier, class T>
Vec3<T> across_direction(const Vec3<T>& v, const Vec3<T>& direction) {
  const T length2 = Tier::dot(direction, direction);
  const Vec3<T> part = v - direction * (Tier::dot(v, direction) / length2);
  if constexpr (MachineNumber<T>) {
    return part - direction * (Tier::dot(part, direction) / length2);
  } else {
    return part;
  }
}

/// From the point of a segment that is nearest to a point.
template <class Tier, class T>
WayBetween<T> shortest_way(const Core<T, 2>& edge, const Vec3<T>& point) {
  const Vec3<T>&v0 = edge.vertices[0], &v1 = edge.vertices[1], &direction = edge.directions[0];
  const Vec3<T> from0 = point - v0;
  const T along = Tier::dot(from0, direction);
  if (along <= T(0)) return {v0, from0};
  const Vec3<T> from1 = point - v1;
  if (Tier::dot(from1, direction) >= T(0)) return {v1, from1};
  return {v0 + direction * (along / Tier::dot(direction, direction)), across_direction<Tier>(from0, direction), true};
}
/// To that point.
template <class Tier, class T>
WayBetween<T> shortest_way(const Vec3<T>& point, const Core<T, 2>& edge) {
  const WayBetween<T> back = shortest_way<Tier>(edge, point);
  return {point, -back.way, false, back.from_within};
}

template <class Tier, class T>
WayBetween<T> shortest_way(const Core<T, 1>& a, const Core<T, 1>& b) {
  return {a.vertices[0], b.vertices[0] - a.vertices[0]};
}
template <class Tier, class T>
WayBetween<T> shortest_way(const Core<T, 1>& a, const Core<T, 2>& b) {
  return shortest_way<Tier>(a.vertices[0], b);
}

/// The part of the second segment's direction that is perpendicular to the first one; zero where they are parallel.
template <class Tier, class T>
Vec3<T> second_across_first(const Core<T, 2>& a, const Core<T, 2>& b) {
  const Vec3<T>& along = a.directions[0];
  return Tier::dot(along, along) > T(0) ? across_direction<Tier>(b.directions[0], along) : Vec3<T>{};
}

/// A point of a segment: an end, or within.
template <class T>
struct PointOfSegment {
  Vec3<T> at;
  bool within = false;
};

/// The point of the second segment that is nearest to the line of the first one; of parallel segments, any end.
template <class Tier, class T>
PointOfSegment<T> nearest_to_line(const Core<T, 2>& a, const Core<T, 2>& b) {
  const Vec3<T> across = second_across_first<Tier>(a, b);
  const Vec3<T>&v0 = b.vertices[0], &v1 = b.vertices[1];
  const T across2 = Tier::dot(across, across);
  if (!(across2 > T(0))) return {v0};
  const Vec3<T>& along = a.directions[0];
  const T before = -Tier::dot(across_direction<Tier>(v0 - a.vertices[0], along), across);
  if (before <= T(0)) return {v0};
  const T behind = -Tier::dot(across_direction<Tier>(v1 - a.vertices[0], along), across);
  if (behind >= T(0)) return {v1};
  // Not before / across2, which rounding takes beyond the end of a segment that is nearly parallel.
  return {v0 + (v1 - v0) * (before / (before - behind)), true};
}

/// The nearest point of the first segment to the one that is nearest to its line. If that is an end, the nearest point
/// of the second segment may be another.
template <class Tier, class T>
WayBetween<T> shortest_way(const Core<T, 2>& a, const Core<T, 2>& b) {
  const PointOfSegment<T> to = nearest_to_line<Tier>(a, b);
  WayBetween<T> way = shortest_way<Tier>(a, to.at);
  if (!way.from_within) return shortest_way<Tier>(way.from, b);
  way.to_within = to.within;
  return way;
}

/// A vector perpendicular to `v`, of any length; of a zero vector, any.
template <class Tier, class T>
Vec3<T> any_perpendicular(const Vec3<T>& v) {
  const T x = abs(v.x), y = abs(v.y), z = abs(v.z);
  if (x <= y && x <= z) return v.y == T(0) && v.z == T(0) ? Vec3<T>{T(1), T(0), T(0)} : Vec3<T>{T(0), -v.z, v.y};
  return y <= z ? Vec3<T>{v.z, T(0), -v.x} : Vec3<T>{-v.y, v.x, T(0)};
}

/// A direction perpendicular to both cores.
template <class Tier, class T>
Vec3<T> direction_across(const Core<T, 1>&, const Core<T, 1>&) {
  return {T(1), T(0), T(0)};
}
template <class Tier, class T>
Vec3<T> direction_across(const Core<T, 1>&, const Core<T, 2>& b) {
  return any_perpendicular<Tier>(b.directions[0]);
}
template <class Tier, class T>
Vec3<T> direction_across(const Core<T, 2>& a, const Core<T, 2>& b) {
  const Vec3<T>& along = a.directions[0];
  const Vec3<T> normal = Tier::cross(along, second_across_first<Tier>(a, b));
  if (Tier::dot(normal, normal) > T(0)) return normal;
  return any_perpendicular<Tier>(Tier::dot(along, along) > T(0) ? along : b.directions[0]);
}

template <class Tier, class T>
Vec3<T> unit_of(const Vec3<T>& v) {
  const Vec3<T> moderate = of_moderate_length(v);
  return moderate * (T(1) / sqrt(Tier::dot(moderate, moderate)));
}

/// How far a right answer is from one with this unit normal, to first order: how far the way leads aside of the normal;
/// and of each core, by how much a vertex is further along the normal than the point of the way, or the ends of a
/// segment are not equally far where the point lies within.
template <class Tier, class T, int of_a, int of_b>
T defect_of(const Vec3<T>& normal, const WayBetween<T>& way, const Core<T, of_a>& a, const Core<T, of_b>& b) {
  const T along = Tier::dot(way.way, normal), from = Tier::dot(way.from, normal);
  const Vec3<T> aside = way.way - normal * along;
  const ProjectedRange<T> on_a = projected<Tier>(a, normal), on_b = projected<Tier>(b, normal);
  const T beyond_a = way.from_within ? on_a.most - on_a.least : on_a.most - from,
          beyond_b = way.to_within ? on_b.most - on_b.least : (from + along) - on_b.least;
  return sqrt(Tier::dot(aside, aside)) + beyond_a + beyond_b;
}

/// The unit normal from A to B that belongs to the way.
template <class Tier, class T, int of_a, int of_b>
Vec3<T> normal_of(const WayBetween<T>& way, const Core<T, of_a>& a, const Core<T, of_b>& b) {
  if (way.way == Vec3<T>{}) return unit_of<Tier>(direction_across<Tier>(a, b));
  const Vec3<T> normal = unit_of<Tier>(way.way);
  if constexpr (MachineNumber<T> && (of_a == 2 || of_b == 2)) {
    Vec3<T> other = unit_of<Tier>(direction_across<Tier>(a, b));
    if (Tier::dot(other, way.way) < T(0)) other = -other;
    if (defect_of<Tier>(other, way, a, b) < defect_of<Tier>(normal, way, a, b)) return other;
  }
  return normal;
}

}  // namespace detail

namespace kernels {

/// The kernel of every signed distance of this kind.
template <class Tier, class A, class B>
inline auto signed_distance(const A& a, const B& b) {
  const auto& origin = detail::any_point_of(a);
  using T = std::remove_cvref_t<decltype(origin.x)>;
  const auto first = detail::core_of<Tier>(a, origin);
  const auto second = detail::core_of<Tier>(b, origin);
  const detail::WayBetween<T> way = detail::shortest_way<Tier>(first, second);
  const Vec3<T> normal = detail::normal_of<Tier>(way, first, second);
  const T apart = Tier::dot(way.way, normal), distance = apart - (first.radius + second.radius);
  // The point of the larger radius follows from the other one, so that both belong to the normal and the distance.
  if (first.radius <= second.radius) {
    const Vec3<T> point1 = (origin + way.from) + normal * first.radius;
    return SignedDistance<T>{distance, normal, point1, point1 + normal * distance};
  }
  const Vec3<T> point2 = (origin + (way.from + way.way)) - normal * second.radius;
  return SignedDistance<T>{distance, normal, point2 - normal * distance, point2};
}

}  // namespace kernels

namespace contracts {

/// First order, but for nearly parallel segments, whose errors cases alone bound. A length is at most 2 sqrt(3) G. In
/// eps of G: a vertex and a direction have an error of 2 each; the foot of a perpendicular 22 along its edge, as in
/// closest_point_segment; the way 5 of its length, so 17; a normal across an edge is off by 4 eps of a right angle, and
/// across the second one by 9, so that turning the edges by as much adds 31; the product of the way and the normal 28;
/// the sums for each point 10. Together 112. In eps of the radii: the length of the normal 4, products and sums 3.
template <class Tier, class T>
constexpr Contract signed_distance() {
  return Tier::template contract<T>(
      {.backward = 128, .unit = 8, .lowest = lowest_for<T>(3), .highest = highest_for<T>(3)});
}

}  // namespace contracts
}  // namespace collide

// NOLINTBEGIN(bugprone-macro-parentheses): a type and a name that is declared have none

/// Defines the function `name` of two shapes, its kernel and its contract.
#define COLLIDE_SIGNED_DISTANCE(name, First, first, Second, second)                                   \
  COLLIDE_COMPILED(name)                                                                              \
  namespace kernels {                                                                                 \
  template <class Tier, class T>                                                                      \
  inline SignedDistance<T> name(const First<T>& first, const Second<T>& second) {                     \
    if constexpr (Tier::template lifts<T>) {                                                          \
      return COLLIDE_LIFTED(name, first, second);                                                     \
    } else {                                                                                          \
      return signed_distance<Tier>(first, second);                                                    \
    }                                                                                                 \
  }                                                                                                   \
  }                                                                                                   \
  namespace contracts {                                                                               \
  template <class Tier = Fast, class T = double>                                                      \
  constexpr Contract name() {                                                                         \
    return signed_distance<Tier, T>();                                                                \
  }                                                                                                   \
  }                                                                                                   \
  template <class Tier = Fast, class T>                                                               \
  [[nodiscard]] inline SignedDistance<T> name(const First<T>& first,                                  \
                                              const Second<T>& second) noexcept(Tier::never_throws) { \
    COLLIDE_ANSWER(name, TierOfNumbers<Tier>, first, second);                                         \
  }

// NOLINTEND(bugprone-macro-parentheses)

#include <collide/detail/strict_end.hpp>
