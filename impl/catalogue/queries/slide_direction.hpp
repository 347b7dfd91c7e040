/// The direction in which a sphere slides on along a contact.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct slide_direction {
  using Answer = collide::Direction<T>;

  Sphere<T> sphere{};
  Vec3<T> velocity{};
  T time{};
  Vec3<T> location{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &slide_direction::sphere),
                      member("velocity", &slide_direction::velocity, Role::velocity),
                      member("time", &slide_direction::time, Role::time),
                      member("location", &slide_direction::location, Role::position));
  }

  static constexpr Traits traits{};
};

}  // namespace nearmiss::inputs
