/// The function takes a prepared ray and a prepared box.
#pragma once

#include <tuple>

#include <collide/ray_aabox.hpp>

#include "impl/adapters/collide_function.hpp"
#include "impl/catalogue/queries/ray_aabox.hpp"

namespace nearmiss::adapters {

template <class T>
struct CollideArguments<inputs::ray_aabox<T>> {
  template <class Tier>
  static auto of(const inputs::ray_aabox<T>& q) noexcept {
    return std::tuple(collide::prepare_ray<Tier>(q.ray), collide::prepare_aabox<Tier>(q.aabox));
  }
};

}  // namespace nearmiss::adapters
