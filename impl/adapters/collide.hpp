/// The tiers of our own library as subjects.
#pragma once

#include <collide/tiers.hpp>

#include "impl/subject/adapter.hpp"

namespace nearmiss::adapters {

/// One tier of `collide` in one scalar.
template <class Tier, class T>
struct Collide {
  using Number = T;
  static std::string version() { return "0.1.0"; }

  template <class Q>
    requires requires(const Q& q) { q.template ask<Tier>(); }
  static auto answer(const Q& q) {
    return q.template ask<Tier>();
  }
  template <class Q>
  static collide::Contract contract() {
    return Tier::template contract<T>(Q::contract(collide::Fast{}));
  }
};

using CollideFastFloat = Collide<collide::Fast, float>;
using CollideFastDouble = Collide<collide::Fast, double>;
using CollideAccurateFloat = Collide<collide::Accurate, float>;
using CollideAccurateDouble = Collide<collide::Accurate, double>;

}  // namespace nearmiss::adapters
