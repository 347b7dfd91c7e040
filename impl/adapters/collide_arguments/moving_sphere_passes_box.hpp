/// An unlimited motion is a limit of infinity.
#pragma once

#include <limits>
#include <tuple>

#include "impl/adapters/collide_function.hpp"
#include "impl/catalogue/queries/moving_sphere_passes_box.hpp"

namespace nearmiss::adapters {

template <class T>
struct CollideArguments<inputs::moving_sphere_passes_box<T>> {
  template <class Tier>
  static auto of(const inputs::moving_sphere_passes_box<T>& q) noexcept {
    return std::tuple(q.sphere, q.velocity, q.box, q.forever ? std::numeric_limits<T>::infinity() : q.limit);
  }
};

}  // namespace nearmiss::adapters
