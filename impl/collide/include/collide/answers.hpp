/// The answers of the queries: a small closed set of plain structs.
///
/// `yes()` gives the decision of an answer: a hit, an overlap, a point inside. Touching is yes. A query that always has
/// an answer, such as a closest point, always says yes. The other numbers of an answer are meaningful only where their
/// comments say so.
#pragma once

#include <array>
#include <limits>

#include <collide/vec3.hpp>

namespace collide {

/// Yes or no. Touching is yes.
template <class T>
struct Decision {
  bool decision = false;

  [[nodiscard]] constexpr bool yes() const { return decision; }
  static constexpr auto decision_member() { return &Decision::decision; }
  static constexpr auto members() { return std::tuple<>(); }
};

// Answers with a location store it before the flags: an answer in float is then returned in two registers, and the
// location does not straddle them.

/// Whether a point lies in a triangle, both projected along an axis.
template <class T>
struct Containment {
  Vec3<T> weights{};  ///< barycentric: weights of v0, v1, v2 with sum 1; zero outside
  bool decision = false;

  [[nodiscard]] constexpr bool yes() const { return decision; }
  static constexpr auto decision_member() { return &Containment::decision; }
  static constexpr auto members() { return std::tuple(member("weights", &Containment::weights, Role::weight)); }
};

/// Whether a ray meets a solid, and where.
template <class T>
struct RayHit {
  Vec3<T> location{};  ///< the entry point, or the origin if that lies inside; zero for a miss
  bool decision = false;
  bool inside = false;  ///< the ray's origin lies in the solid

  [[nodiscard]] constexpr bool yes() const { return decision; }
  static constexpr auto decision_member() { return &RayHit::decision; }
  static constexpr auto members() {
    return std::tuple(member("inside", &RayHit::inside, Role::flag),
                      member("location", &RayHit::location, Role::position));
  }
};

/// Whether two boxes overlap and, if not, an axis that separates them.
template <class T>
struct BoxOverlap {
  bool decision = false;
  int axis = -1;  ///< a separating axis, 0..14, useful as the next call's hint; -1: they overlap

  [[nodiscard]] constexpr bool yes() const { return decision; }
  static constexpr auto decision_member() { return &BoxOverlap::decision; }
  static constexpr auto members() { return std::tuple(member("axis", &BoxOverlap::axis, Role::index)); }
};

/// Which axes of two boxes are parallel.
template <class T>
struct ParallelAxes {
  bool decision = false;
  int axis1 = -1, axis2 = -1;  ///< axis of box 1 and of box 2, 0..2; -1 if none are parallel

  [[nodiscard]] constexpr bool yes() const { return decision; }
  static constexpr auto decision_member() { return &ParallelAxes::decision; }
  static constexpr auto members() {
    return std::tuple(member("axis1", &ParallelAxes::axis1, Role::index),
                      member("axis2", &ParallelAxes::axis2, Role::index));
  }
};

/// The first contact of a moving shape with a fixed one.
template <class T>
struct Impact {
  T time = std::numeric_limits<T>::infinity();  ///< displacement = velocity * time; +infinity: a miss
  Vec3<T> location{};                           ///< the contact point on the fixed shape; zero for a miss
  Vec3<T> normal{};                             ///< unit, from the fixed shape to the moving one; zero for a miss

  static constexpr Impact miss() { return {}; }
  [[nodiscard]] constexpr bool yes() const { return time < std::numeric_limits<T>::infinity(); }
  static constexpr auto members() {
    return std::tuple(member("time", &Impact::time, Role::time), member("location", &Impact::location, Role::position),
                      member("normal", &Impact::normal, Role::normal));
  }
};

/// The first contact of a moving shape with a triangle.
template <class T>
struct TriangleImpact {
  T time = std::numeric_limits<T>::infinity();  ///< displacement = velocity * time; +infinity: a miss
  Vec3<T> location{};                           ///< the contact point on the triangle; zero for a miss
  Vec3<T> normal{};                             ///< unit, from the triangle to the moving shape; zero for a miss
  Vec3<T> weights{};  ///< barycentric: location = x v0 + y v1 + z v2, x + y + z = 1; zero for a miss

  static constexpr TriangleImpact miss() { return {}; }
  [[nodiscard]] constexpr bool yes() const { return time < std::numeric_limits<T>::infinity(); }
  static constexpr auto members() {
    return std::tuple(member("time", &TriangleImpact::time, Role::time),
                      member("location", &TriangleImpact::location, Role::position),
                      member("normal", &TriangleImpact::normal, Role::normal),
                      member("weights", &TriangleImpact::weights, Role::weight));
  }
};

/// The entry of a moving point into a solid, from outside.
template <class T>
struct Entry {
  bool inside = false;  ///< the point starts in the solid, which is a miss
  Vec3<T> location{};   ///< the entry point; the start if that lies inside; zero for another miss
  T time = std::numeric_limits<T>::infinity();  ///< displacement = velocity * time; +infinity: a miss
  Vec3<T> normal{};                             ///< unit, outward; zero for a miss

  static constexpr Entry miss() { return {}; }
  [[nodiscard]] constexpr bool yes() const { return time < std::numeric_limits<T>::infinity(); }
  static constexpr auto members() {
    return std::tuple(member("inside", &Entry::inside, Role::flag),
                      member("location", &Entry::location, Role::position), member("time", &Entry::time, Role::time),
                      member("normal", &Entry::normal, Role::normal));
  }
};

/// The times t >= 0 at which a moving point is in a convex solid: an interval, both ends included.
template <class T>
struct Span {
  T enter{};  ///< displacement = velocity * time; 0: it starts in the solid; 0 for a miss
  T exit{};  ///< not before `enter`; equal: a touch; +infinity: it stays, or leaves later than any number; 0 for a miss
  bool decision = false;

  static constexpr Span miss() { return {}; }
  [[nodiscard]] constexpr bool yes() const { return decision; }
  static constexpr auto decision_member() { return &Span::decision; }
  static constexpr auto members() {
    return std::tuple(member("enter", &Span::enter, Role::time), member("exit", &Span::exit, Role::time));
  }
};

/// The time at which the event of a motion begins: that of a contact, or the first one of a span.
template <class A>
  requires requires(const A& answer) {
    A::miss();
    answer.time;
  }
constexpr const auto& first_time(const A& answer) {
  return answer.time;
}
template <class T>
constexpr const T& first_time(const Span<T>& span) {
  return span.enter;
}

/// The point of a shape closest to a given point.
template <class T>
struct ClosestPoint {
  Vec3<T> point{};

  [[nodiscard]] static constexpr bool yes() { return true; }
  static constexpr auto members() { return std::tuple(member("point", &ClosestPoint::point, Role::position)); }
};

/// The point of a triangle's perimeter closest to a given point, and its edge.
template <class T>
struct EdgePoint {
  Vec3<T> point{};
  int edge = 0;  ///< edge i runs from v[i] to v[(i + 1) % 3]

  [[nodiscard]] static constexpr bool yes() { return true; }
  static constexpr auto members() {
    return std::tuple(member("point", &EdgePoint::point, Role::position),
                      member("edge", &EdgePoint::edge, Role::index));
  }
};

/// The closest points of two shapes.
template <class T>
struct ClosestPoints {
  Vec3<T> point1{};  ///< on the first shape
  Vec3<T> point2{};  ///< on the second shape

  [[nodiscard]] static constexpr bool yes() { return true; }
  static constexpr auto members() {
    return std::tuple(member("point1", &ClosestPoints::point1, Role::position),
                      member("point2", &ClosestPoints::point2, Role::position));
  }
};

/// The signed distance of two shapes, and the two points that have it: the nearest points of shapes that are apart, the
/// deepest ones of shapes that overlap. point2 - point1 = distance * normal.
template <class T>
struct SignedDistance {
  T distance{};      ///< 0: touching; negative: minus the length of the shortest translation that parts them
  Vec3<T> normal{};  ///< unit, from the first shape to the second: the direction of such a translation of the second
  Vec3<T> point1{};  ///< the point of the first shape that is furthest along `normal`, one of them
  Vec3<T> point2{};  ///< the point of the second shape that is least far along `normal`, one of them

  [[nodiscard]] static constexpr bool yes() { return true; }
  static constexpr auto members() {
    return std::tuple(member("distance", &SignedDistance::distance, Role::distance),
                      member("normal", &SignedDistance::normal, Role::normal),
                      member("point1", &SignedDistance::point1, Role::position),
                      member("point2", &SignedDistance::point2, Role::position));
  }
};

/// The penetration depth of two shapes, with one contact point.
template <class T>
struct Penetration {
  T depth{};          ///< length; 0: touching; negative: apart
  Vec3<T> normal{};   ///< unit, from the first shape into the second (of a plane: its normal); zero when apart
  Vec3<T> contact{};  ///< the contact point that the query defines; zero when apart

  [[nodiscard]] constexpr bool yes() const { return depth >= T(0); }
  static constexpr auto members() {
    return std::tuple(member("depth", &Penetration::depth, Role::depth),
                      member("normal", &Penetration::normal, Role::normal),
                      member("contact", &Penetration::contact, Role::position));
  }
};

/// The penetration depth of two boxes, or their separation along one of the fifteen axes.
template <class T>
struct BoxPenetration {
  T depth{};          ///< length; 0: touching; negative: minus the separation along `axis`
  int axis = 0;       ///< 0..14, along which the depth is measured; useful as the next call's hint
  Vec3<T> normal{};   ///< unit, from box 1 into box 2; zero when apart
  Vec3<T> contact{};  ///< the contact point that the query defines; zero when apart

  [[nodiscard]] constexpr bool yes() const { return depth >= T(0); }
  static constexpr auto members() {
    return std::tuple(member("depth", &BoxPenetration::depth, Role::depth),
                      member("axis", &BoxPenetration::axis, Role::index),
                      member("normal", &BoxPenetration::normal, Role::normal),
                      member("contact", &BoxPenetration::contact, Role::position));
  }
};

/// A corner of a box, which may be a contact with a plane.
template <class T>
struct Corner {
  /// bool for floating-point T. For a number type with uncertain values it is that type, with the values 0 and 1.
  using Flag = std::conditional_t<std::is_floating_point_v<T>, bool, T>;

  Flag behind{};    ///< true: on the plane or behind it, a contact
  Vec3<T> point{};  ///< the corner; zero if it is not a contact

  static constexpr auto members() {
    return std::tuple(member("behind", &Corner::behind, Role::flag), member("point", &Corner::point, Role::position));
  }
};

/// The depth of a box behind a plane, with all corners that are contacts.
template <class T>
struct CornerContacts {
  T depth{};         ///< depth of the deepest corner; 0: touching; negative: apart
  Vec3<T> normal{};  ///< the plane's unit normal; zero when apart
  /// Corner i is center + sum over axes k of (bit k of i ? +1 : -1) * half[k] * axis k.
  std::array<Corner<T>, 8> corners{};

  [[nodiscard]] constexpr bool yes() const { return depth >= T(0); }
  static constexpr auto members() {
    return std::tuple(member("depth", &CornerContacts::depth, Role::depth),
                      member("normal", &CornerContacts::normal, Role::normal),
                      member("corners", &CornerContacts::corners));
  }
};

/// A single number.
template <class T>
struct Measure {
  T value{};

  [[nodiscard]] static constexpr bool yes() { return true; }
  static constexpr auto members() { return std::tuple(member("value", &Measure::value, Role::distance)); }
};

/// The values that the queries about pairs of boxes share, computed once for a pair.
template <class T>
struct BoxBoxInfo {
  Vec3<T> half1{}, half2{};             ///< the half extents of both boxes
  Vec3<T> between{};                    ///< center 2 - center 1
  std::array<Vec3<T>, 3> cosine{};      ///< cosine[i].x, .y, .z: axis i of box 1 . axes 0, 1, 2 of box 2
  std::array<Vec3<T>, 3> abs_cosine{};  ///< the absolute values of `cosine`
  Vec3<T> between1{}, between2{};       ///< `between` in the frame of box 1 and of box 2

  [[nodiscard]] static constexpr bool yes() { return true; }
  static constexpr auto members() {
    return std::tuple(member("half1", &BoxBoxInfo::half1, Role::size), member("half2", &BoxBoxInfo::half2, Role::size),
                      member("between", &BoxBoxInfo::between, Role::position),
                      member("cosine", &BoxBoxInfo::cosine, Role::weight),
                      member("abs_cosine", &BoxBoxInfo::abs_cosine, Role::weight),
                      member("between1", &BoxBoxInfo::between1, Role::position),
                      member("between2", &BoxBoxInfo::between2, Role::position));
  }
};

/// A direction: a unit vector, or a shorter one where the query says so.
template <class T>
struct Direction {
  Vec3<T> direction{};

  [[nodiscard]] static constexpr bool yes() { return true; }
  static constexpr auto members() { return std::tuple(member("direction", &Direction::direction, Role::direction)); }
};

}  // namespace collide
