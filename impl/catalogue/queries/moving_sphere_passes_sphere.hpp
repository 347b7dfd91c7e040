/// Whether a moving sphere comes to a fixed one within a time limit.
#pragma once

#include "impl/catalogue/inputs.hpp"

namespace nearmiss::inputs {

template <class T>
struct moving_sphere_passes_sphere {
  using Answer = collide::Decision<T>;

  Sphere<T> sphere{};
  Vec3<T> velocity{};
  Sphere<T> fixed{};
  T limit{1};
  bool forever = false;  ///< no limit: `limit` is ignored

  static constexpr auto members() {
    return std::tuple(member("sphere", &moving_sphere_passes_sphere::sphere),
                      member("velocity", &moving_sphere_passes_sphere::velocity, Role::velocity),
                      member("fixed", &moving_sphere_passes_sphere::fixed),
                      member("limit", &moving_sphere_passes_sphere::limit, Role::time),
                      member("forever", &moving_sphere_passes_sphere::forever, Role::flag));
  }
  std::optional<Broken> broken() const {
    if (limit < T(0)) return Broken{"limit", "not negative", double(limit)};
    return std::nullopt;
  }

  static constexpr Traits traits{.grows = true};
};

}  // namespace nearmiss::inputs
