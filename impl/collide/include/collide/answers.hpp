/// What the queries return: a small closed set of kinds, each one plain struct.
///
/// Every answer has its decision in `yes()`: a hit, an overlap, a point inside; touching is yes. A query that always
/// has an answer (a nearest point) always says yes. The numbers of an answer hold only where its comment says so.
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

// Of a decision with a place the place is first: in float such an answer comes back in two registers, and a place
// behind the flags would lie in both.

/// Whether a point lies in a triangle, seen along an axis.
template <class T>
struct Containment {
  Vec3<T> weights{};  ///< x, y, z are the weights of v0, v1, v2; their sum is 1; zero outside
  bool decision = false;

  [[nodiscard]] constexpr bool yes() const { return decision; }
  static constexpr auto decision_member() { return &Containment::decision; }
  static constexpr auto members() { return std::tuple(member("weights", &Containment::weights, Role::weight)); }
};

/// Whether a ray meets a solid, and where.
template <class T>
struct RayHit {
  Vec3<T> location{};  ///< where the ray enters, its origin for a start inside; zero for a miss
  bool decision = false;
  bool inside = false;  ///< the ray starts in the solid

  [[nodiscard]] constexpr bool yes() const { return decision; }
  static constexpr auto decision_member() { return &RayHit::decision; }
  static constexpr auto members() {
    return std::tuple(member("inside", &RayHit::inside, Role::flag),
                      member("location", &RayHit::location, Role::position));
  }
};

/// Whether two boxes overlap, and what keeps them apart.
template <class T>
struct BoxOverlap {
  bool decision = false;
  int axis = -1;  ///< an axis 0..14 that separates them, the hint for the next time; -1 where they overlap

  [[nodiscard]] constexpr bool yes() const { return decision; }
  static constexpr auto decision_member() { return &BoxOverlap::decision; }
  static constexpr auto members() { return std::tuple(member("axis", &BoxOverlap::axis, Role::index)); }
};

/// Which axes of two boxes are parallel.
template <class T>
struct ParallelAxes {
  bool decision = false;
  int axis1 = -1, axis2 = -1;  ///< 0..2, of box 1 and of box 2; -1 where none are

  [[nodiscard]] constexpr bool yes() const { return decision; }
  static constexpr auto decision_member() { return &ParallelAxes::decision; }
  static constexpr auto members() {
    return std::tuple(member("axis1", &ParallelAxes::axis1, Role::index),
                      member("axis2", &ParallelAxes::axis2, Role::index));
  }
};

/// The first contact of a moving thing with a fixed one.
template <class T>
struct Impact {
  T time = std::numeric_limits<T>::infinity();  ///< displacement = velocity * time; +infinity: a miss
  Vec3<T> location{};                           ///< contact on the fixed object; zero for a miss
  Vec3<T> normal{};                             ///< unit, from the fixed object to the moving one; zero for a miss

  static constexpr Impact miss() { return {}; }
  [[nodiscard]] constexpr bool yes() const { return time < std::numeric_limits<T>::infinity(); }
  static constexpr auto members() {
    return std::tuple(member("time", &Impact::time, Role::time), member("location", &Impact::location, Role::position),
                      member("normal", &Impact::normal, Role::normal));
  }
};

/// The first contact of a moving thing with a triangle.
template <class T>
struct TriangleImpact {
  T time = std::numeric_limits<T>::infinity();  ///< displacement = velocity * time; +infinity: a miss
  Vec3<T> location{};                           ///< contact on the triangle; zero for a miss
  Vec3<T> normal{};                             ///< unit, from the triangle to the moving thing; zero for a miss
  Vec3<T> weights{};                            ///< location = x v0 + y v1 + z v2, x + y + z = 1; zero for a miss

  static constexpr TriangleImpact miss() { return {}; }
  [[nodiscard]] constexpr bool yes() const { return time < std::numeric_limits<T>::infinity(); }
  static constexpr auto members() {
    return std::tuple(member("time", &TriangleImpact::time, Role::time),
                      member("location", &TriangleImpact::location, Role::position),
                      member("normal", &TriangleImpact::normal, Role::normal),
                      member("weights", &TriangleImpact::weights, Role::weight));
  }
};

/// The first contact of a moving point with a solid that it must enter from outside.
template <class T>
struct Entry {
  bool inside = false;                          ///< starts in the solid: a miss
  Vec3<T> location{};                           ///< where it enters; the start, for a start inside; else zero
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

/// One point of the fixed object, nearest to the given one.
template <class T>
struct ClosestPoint {
  Vec3<T> point{};

  [[nodiscard]] static constexpr bool yes() { return true; }
  static constexpr auto members() { return std::tuple(member("point", &ClosestPoint::point, Role::position)); }
};

/// The point of a triangle's perimeter nearest to the given one, and the edge that it lies on.
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

/// The nearest points of two fixed objects.
template <class T>
struct ClosestPoints {
  Vec3<T> point1{};  ///< of the first
  Vec3<T> point2{};  ///< of the second

  [[nodiscard]] static constexpr bool yes() { return true; }
  static constexpr auto members() {
    return std::tuple(member("point1", &ClosestPoints::point1, Role::position),
                      member("point2", &ClosestPoints::point2, Role::position));
  }
};

/// How deep two fixed objects overlap, with one contact.
template <class T>
struct Penetration {
  T depth{};          ///< length; 0 when touching, negative when apart
  Vec3<T> normal{};   ///< unit, from the first object into the second; zero when apart
  Vec3<T> contact{};  ///< zero when apart

  [[nodiscard]] constexpr bool yes() const { return depth >= T(0); }
  static constexpr auto members() {
    return std::tuple(member("depth", &Penetration::depth, Role::depth),
                      member("normal", &Penetration::normal, Role::normal),
                      member("contact", &Penetration::contact, Role::position));
  }
};

/// How deep two boxes overlap, or how far they are apart, along one of fifteen axes.
template <class T>
struct BoxPenetration {
  T depth{};          ///< length; 0 when touching; apart: minus the separation along `axis`
  int axis = 0;       ///< 0..14, along which depth is measured; the hint for the next time
  Vec3<T> normal{};   ///< unit, from box 1 into box 2; zero when apart
  Vec3<T> contact{};  ///< zero when apart

  [[nodiscard]] constexpr bool yes() const { return depth >= T(0); }
  static constexpr auto members() {
    return std::tuple(member("depth", &BoxPenetration::depth, Role::depth),
                      member("axis", &BoxPenetration::axis, Role::index),
                      member("normal", &BoxPenetration::normal, Role::normal),
                      member("contact", &BoxPenetration::contact, Role::position));
  }
};

/// A corner of a box that may lie behind a plane.
template <class T>
struct Corner {
  /// bool; of a number type that can be uncertain, that type with the values 0 and 1.
  using Flag = std::conditional_t<std::is_floating_point_v<T>, bool, T>;

  Flag behind{};    ///< on the plane or behind it: a contact
  Vec3<T> point{};  ///< zero in front

  static constexpr auto members() {
    return std::tuple(member("behind", &Corner::behind, Role::flag), member("point", &Corner::point, Role::position));
  }
};

/// How deep a box reaches behind a plane, with every corner that does.
template <class T>
struct CornerContacts {
  T depth{};         ///< of the deepest corner; 0 when touching, negative when apart
  Vec3<T> normal{};  ///< unit, the plane's; zero when apart
  /// Corner i is center + sum over axes k of (bit k of i ? +1 : -1) * half[k] * axis k.
  std::array<Corner<T>, 8> corners{};

  [[nodiscard]] constexpr bool yes() const { return depth >= T(0); }
  static constexpr auto members() {
    return std::tuple(member("depth", &CornerContacts::depth, Role::depth),
                      member("normal", &CornerContacts::normal, Role::normal),
                      member("corners", &CornerContacts::corners));
  }
};

/// A number that always exists.
template <class T>
struct Measure {
  T value{};

  [[nodiscard]] static constexpr bool yes() { return true; }
  static constexpr auto members() { return std::tuple(member("value", &Measure::value, Role::depth)); }
};

/// What the tools for pairs of boxes share: computed once for a pair.
template <class T>
struct BoxBoxInfo {
  Vec3<T> half1{}, half2{};             ///< half extents: from each center to a corner, in its own frame
  Vec3<T> between{};                    ///< center 2 - center 1
  std::array<Vec3<T>, 3> cosine{};      ///< cosine[i].x, .y, .z: axis i of box 1 . axis 0, 1, 2 of box 2
  std::array<Vec3<T>, 3> abs_cosine{};  ///< their absolute values
  Vec3<T> between1{}, between2{};       ///< `between` along the axes of box 1, of box 2

  [[nodiscard]] static constexpr bool yes() { return true; }
  static constexpr auto members() {
    return std::tuple(
        member("half1", &BoxBoxInfo::half1, Role::position), member("half2", &BoxBoxInfo::half2, Role::position),
        member("between", &BoxBoxInfo::between, Role::position), member("cosine", &BoxBoxInfo::cosine, Role::weight),
        member("abs_cosine", &BoxBoxInfo::abs_cosine, Role::weight),
        member("between1", &BoxBoxInfo::between1, Role::position),
        member("between2", &BoxBoxInfo::between2, Role::position));
  }
};

/// A direction after a response to a contact: at most unit length.
template <class T>
struct Direction {
  Vec3<T> direction{};

  [[nodiscard]] static constexpr bool yes() { return true; }
  static constexpr auto members() { return std::tuple(member("direction", &Direction::direction, Role::weight)); }
};

}  // namespace collide
