/// When and where a moving sphere meets a one-sided triangle.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_sphere_triangle {
  using Answer = collide::TriangleImpact<T>;

  Sphere<T> sphere{};
  Vec3<T> velocity{};
  Triangle<T> triangle{};

  static constexpr auto members() {
    return std::tuple(member("sphere", &moving_sphere_triangle::sphere),
                      member("velocity", &moving_sphere_triangle::velocity, Role::velocity),
                      member("triangle", &moving_sphere_triangle::triangle));
  }

  static constexpr Link links[] = {
      {.kind = Link::Kind::at_rest, .to = query_id("sphere_triangle_overlap")},
  };
  static constexpr Traits traits{.one_sided = true, .grows = true, .ties = {Tie::cone}, .links = links};
};

}  // namespace nearmiss::inputs
