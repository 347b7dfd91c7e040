/// Whether a point lies in a triangle, both seen along an axis.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct point_in_triangle {
  using Answer = collide::Containment<T>;

  Triangle<T> triangle{};
  Vec3<T> normal{T(0), T(0), T(1)};
  int axis = -1;
  Vec3<T> point{};

  static constexpr auto members() {
    return std::tuple(member("triangle", &point_in_triangle::triangle),
                      member("normal", &point_in_triangle::normal, Role::direction),
                      member("axis", &point_in_triangle::axis, Role::index),
                      member("point", &point_in_triangle::point, Role::position));
  }
  std::optional<Broken> broken() const {
    if (axis < -1 || axis > 2) return Broken{"axis", "-1, 0, 1 or 2", double(axis)};
    return std::nullopt;
  }

  static constexpr Traits traits{.decision = {"the point is in the triangle", "the point is outside of the triangle"},
                                 .projects = true,
                                 .directions_are_lines = true,
                                 .ties = {Tie::weight}};
};

}  // namespace nearmiss::inputs
