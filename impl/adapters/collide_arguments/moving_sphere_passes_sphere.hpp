/// An unlimited motion is a limit of infinity. Any other limit that is not finite becomes NaN.
#pragma once

#include <cmath>
#include <limits>
#include <tuple>

#include "impl/adapters/collide_function.hpp"
#include "impl/catalogue/queries/moving_sphere_passes_sphere.hpp"

namespace nearmiss::adapters {

template <class T>
struct CollideArguments<inputs::moving_sphere_passes_sphere<T>> {
  template <class Tier>
  static auto of(const inputs::moving_sphere_passes_sphere<T>& q) noexcept {
    const bool valid = q.limit >= T(0) && std::isfinite(q.limit);
    const T until = q.forever ? std::numeric_limits<T>::infinity() : q.limit;
    return std::tuple(q.sphere, q.velocity, q.fixed, valid ? until : std::numeric_limits<T>::quiet_NaN());
  }
};

}  // namespace nearmiss::adapters
