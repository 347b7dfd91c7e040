/// How deep a box reaches behind a plane, with every corner that does.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct box_plane_penetration {
  using Answer = collide::CornerContacts<T>;

  Box<T> box{};
  Plane<T> plane{};

  static constexpr auto members() {
    return std::tuple(member("box", &box_plane_penetration::box), member("plane", &box_plane_penetration::plane));
  }

  static constexpr Traits traits{.grows = true};
};

}  // namespace nearmiss::inputs
