/// What the queries return: a small closed set of kinds, each one plain struct.
#pragma once

#include <cmath>
#include <limits>

#include <collide/vec3.hpp>

namespace collide {

/// The kinds of answer. Judging depends on the kind, never on the query.
enum class Kind { decision, impact, points, depth, direction };

/// Yes or no. Touching is yes.
template <class T>
struct Decision {
  static constexpr Kind kind = Kind::decision;
  bool answer = false;

  bool yes() const noexcept { return answer; }
  static constexpr auto members() { return std::tuple<>(); }
};

/// The first contact of a moving thing with a fixed one.
template <class T>
struct Impact {
  static constexpr Kind kind = Kind::impact;
  T time = std::numeric_limits<T>::infinity();  ///< displacement = velocity * time; +infinity: a miss
  Vec3<T> location{};                           ///< contact on the fixed object; zero for a miss
  Vec3<T> normal{};                             ///< unit, from the fixed object to the moving one; zero for a miss

  static constexpr Impact miss() noexcept { return {}; }
  bool yes() const noexcept { return time < std::numeric_limits<T>::infinity(); }
  static constexpr auto members() {
    return std::tuple(member("time", &Impact::time, Role::time),
                      member("location", &Impact::location, Role::position),
                      member("normal", &Impact::normal, Role::normal));
  }
};

/// One point of the fixed object, nearest to the given one.
template <class T>
struct ClosestPoint {
  static constexpr Kind kind = Kind::points;
  Vec3<T> point{};

  static bool yes() noexcept { return true; }
  static constexpr auto members() {
    return std::tuple(member("point", &ClosestPoint::point, Role::position));
  }
};

/// How deep two fixed objects overlap, with one contact.
template <class T>
struct Penetration {
  static constexpr Kind kind = Kind::depth;
  T depth{};          ///< length; 0 when touching, negative when apart
  Vec3<T> normal{};   ///< unit, from the first object into the second; zero when apart
  Vec3<T> contact{};  ///< zero when apart

  bool yes() const noexcept { return depth >= T(0); }
  static constexpr auto members() {
    return std::tuple(member("depth", &Penetration::depth, Role::depth),
                      member("normal", &Penetration::normal, Role::normal),
                      member("contact", &Penetration::contact, Role::position));
  }
};

/// A direction after a response to a contact: at most unit length.
template <class T>
struct Direction {
  static constexpr Kind kind = Kind::direction;
  Vec3<T> direction{};

  static bool yes() noexcept { return true; }
  static constexpr auto members() {
    return std::tuple(member("direction", &Direction::direction, Role::weight));
  }
};

}  // namespace collide
