/// The point of a triangle's perimeter nearest to a point, and its edge, with the edges' unit directions
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct closest_point_triangle_perimeter_edges {
  using Answer = collide::EdgePoint<T>;

  Triangle<T> triangle{};
  Vec3<T> point{};

  static constexpr auto members() {
    return std::tuple(member("triangle", &closest_point_triangle_perimeter_edges::triangle),
                      member("point", &closest_point_triangle_perimeter_edges::point, Role::position));
  }

  static constexpr Traits traits{.ties = {Tie::position, Tie::index}};
};

}  // namespace nearmiss::inputs
