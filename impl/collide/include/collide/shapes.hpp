/// Shapes: plain structs of numbers, each with the point set that it denotes. All solids are closed: they contain their
/// surface.
#pragma once

#include <optional>

#include <collide/vec3.hpp>

namespace collide {

/// A rule that a shape's numbers violate.
struct Broken {
  const char* member;  ///< the member with the wrong value
  const char* rule;    ///< what the value must be
  double value;        ///< the value
};

/// The segment from v0 to v1; a point where v0 == v1.
template <class T>
struct Segment {
  Vec3<T> v0{}, v1{};

  static constexpr auto members() {
    return std::tuple(member("v0", &Segment::v0, Role::position), member("v1", &Segment::v1, Role::position));
  }
};

/// The line through `point` along `direction`, which is not zero and need not have unit length.
template <class T>
struct Line {
  Vec3<T> point{};
  Vec3<T> direction{T(0), T(0), T(1)};

  static constexpr auto members() {
    return std::tuple(member("point", &Line::point, Role::position),
                      member("direction", &Line::direction, Role::direction));
  }
};

/// The points origin + direction * t with t >= 0; `direction` is not zero and need not have unit length.
template <class T>
struct Ray {
  Vec3<T> origin{};
  Vec3<T> direction{T(0), T(0), T(1)};

  static constexpr auto members() {
    return std::tuple(member("origin", &Ray::origin, Role::position),
                      member("direction", &Ray::direction, Role::direction));
  }
};

/// The points x with normal . x + offset = 0. The front is where normal . x + offset > 0. `normal` is not zero and need
/// not have unit length.
template <class T>
struct Plane {
  Vec3<T> normal{T(0), T(0), T(1)};
  T offset{};

  static constexpr auto members() {
    return std::tuple(member("normal", &Plane::normal, Role::direction),
                      member("offset", &Plane::offset, Role::offset));
  }
};

/// The half-space of the points x with normal . x + offset <= 0: its plane, and all behind it. `normal` leads out; it
/// is not zero and need not have unit length.
template <class T>
struct HalfSpace {
  Vec3<T> normal{T(0), T(0), T(1)};
  T offset{};

  static constexpr auto members() {
    return std::tuple(member("normal", &HalfSpace::normal, Role::direction),
                      member("offset", &HalfSpace::offset, Role::offset));
  }
};

/// The convex hull of three points. The front is the side to which (v1 - v0) x (v2 - v0) points: from there the
/// vertices run counterclockwise. Three points on one line are a segment or a point.
template <class T>
struct Triangle {
  Vec3<T> v0{}, v1{}, v2{};

  static constexpr auto members() {
    return std::tuple(member("v0", &Triangle::v0, Role::position), member("v1", &Triangle::v1, Role::position),
                      member("v2", &Triangle::v2, Role::position));
  }
};

/// The union of the triangles v0, v1, v2 and v0, v2, v3: a rectangle if the four points are its corners in order. Any
/// four points are allowed. The perimeter is the four segments v0 v1, v1 v2, v2 v3, v3 v0.
template <class T>
struct Rectangle {
  Vec3<T> v0{}, v1{}, v2{}, v3{};

  static constexpr auto members() {
    return std::tuple(member("v0", &Rectangle::v0, Role::position), member("v1", &Rectangle::v1, Role::position),
                      member("v2", &Rectangle::v2, Role::position), member("v3", &Rectangle::v3, Role::position));
  }
};

/// The closed ball around `center`; a point where the radius is 0.
template <class T>
struct Sphere {
  Vec3<T> center{};
  T radius{};

  static constexpr auto members() {
    return std::tuple(member("center", &Sphere::center, Role::position), member("radius", &Sphere::radius, Role::size));
  }
  constexpr std::optional<Broken> broken() const noexcept {
    if (radius < T(0)) return Broken{"radius", "not negative", double(radius)};
    return std::nullopt;
  }
};

/// All points within `radius` of the segment from p0 to p1: a ball where p0 == p1, a segment where the radius is 0.
template <class T>
struct Capsule {
  Vec3<T> p0{}, p1{};
  T radius{};

  static constexpr auto members() {
    return std::tuple(member("p0", &Capsule::p0, Role::position), member("p1", &Capsule::p1, Role::position),
                      member("radius", &Capsule::radius, Role::size));
  }
  constexpr std::optional<Broken> broken() const noexcept {
    if (radius < T(0)) return Broken{"radius", "not negative", double(radius)};
    return std::nullopt;
  }
};

/// The axis-aligned box: the points x with min <= x <= max in each coordinate.
template <class T>
struct AABox {
  Vec3<T> min{}, max{};

  static constexpr auto members() {
    return std::tuple(member("min", &AABox::min, Role::position), member("max", &AABox::max, Role::position));
  }
  constexpr std::optional<Broken> broken() const noexcept {
    if (max.x < min.x) return Broken{"max.x", "not below min.x", double(max.x)};
    if (max.y < min.y) return Broken{"max.y", "not below min.y", double(max.y)};
    if (max.z < min.z) return Broken{"max.z", "not below min.z", double(max.z)};
    return std::nullopt;
  }
};

/// The rotation of q / |q|, with q = w + xi + yj + zk. q is not zero and need not have unit length.
template <class T>
struct Quaternion {
  T x{}, y{}, z{}, w{1};

  static constexpr auto members() {
    return std::tuple(member("x", &Quaternion::x), member("y", &Quaternion::y), member("z", &Quaternion::z),
                      member("w", &Quaternion::w));
  }
  constexpr std::optional<Broken> broken() const noexcept {
    if (x == T(0) && y == T(0) && z == T(0) && w == T(0)) return Broken{"w", "not all of x, y, z, w zero", 0.0};
    return std::nullopt;
  }
};

/// The oriented box: the points center + R c with |c.x| <= half.x, |c.y| <= half.y, |c.z| <= half.z, where R is the
/// rotation `orientation`.
template <class T>
struct Box {
  Vec3<T> center{};
  Vec3<T> half{};  ///< half extents: half the length of each side
  Quaternion<T> orientation{};

  static constexpr auto members() {
    return std::tuple(member("center", &Box::center, Role::position), member("half", &Box::half, Role::size),
                      member("orientation", &Box::orientation, Role::rotation));
  }
  constexpr std::optional<Broken> broken() const noexcept {
    if (half.x < T(0)) return Broken{"half.x", "not negative", double(half.x)};
    if (half.y < T(0)) return Broken{"half.y", "not negative", double(half.y)};
    if (half.z < T(0)) return Broken{"half.z", "not negative", double(half.z)};
    return std::nullopt;
  }
};

}  // namespace collide
