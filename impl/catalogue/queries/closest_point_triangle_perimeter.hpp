/// The point of a triangle's perimeter nearest to a point.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct closest_point_triangle_perimeter {
  using Answer = collide::ClosestPoint<T>;

  Triangle<T> triangle{};
  Vec3<T> point{};

  static constexpr auto members() {
    return std::tuple(member("triangle", &closest_point_triangle_perimeter::triangle),
                      member("point", &closest_point_triangle_perimeter::point, Role::position));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::prepared, .to = query_id("closest_point_triangle_perimeter_edges")},
  };
  static constexpr Traits traits{.ties = {Tie::position}, .links = links};
};

}  // namespace nearmiss::inputs
