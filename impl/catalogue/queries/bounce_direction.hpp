/// The direction in which a sphere leaves a contact.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct bounce_direction {
  using Answer = collide::Direction<T>;

  Sphere<T> sphere{};
  Vec3<T> velocity{};
  T time{};
  Vec3<T> location{};
  Vec3<T> normal{T(0), T(0), T(1)};

  static constexpr auto members() {
    return std::tuple(member("sphere", &bounce_direction::sphere),
                      member("velocity", &bounce_direction::velocity, Role::velocity),
                      member("time", &bounce_direction::time, Role::time),
                      member("location", &bounce_direction::location, Role::position),
                      member("normal", &bounce_direction::normal, Role::direction));
  }

  static constexpr Traits traits{.directions_are_lines = true};
};

}  // namespace nearmiss::inputs
