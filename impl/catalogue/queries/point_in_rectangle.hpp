/// Whether a point lies in a rectangle, both seen along an axis.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct point_in_rectangle {
  using Answer = collide::Decision<T>;

  Rectangle<T> rectangle{};
  Vec3<T> normal{T(0), T(0), T(1)};
  Vec3<T> point{};

  static constexpr auto members() {
    return std::tuple(member("rectangle", &point_in_rectangle::rectangle),
                      member("normal", &point_in_rectangle::normal, Role::direction),
                      member("point", &point_in_rectangle::point, Role::position));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::halves, .to = query_id("point_in_triangle"), .set = {"axis", -1}},
  };
  static constexpr Traits traits{.decision = {"the point is in the rectangle", "the point is outside of the rectangle"},
                                 .projects = true,
                                 .directions_are_lines = true,
                                 .links = links};
};

}  // namespace nearmiss::inputs
