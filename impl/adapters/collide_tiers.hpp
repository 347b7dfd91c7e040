/// The tiers Fast and Accurate of `collide` as subjects, without the functions of the queries
/// (nearmiss/collide_functions/QUERY.hpp).
#pragma once

#include <collide/tiers.hpp>
#include <collide/version.hpp>

#include <string>

#include "impl/adapters/collide_function.hpp"
#include "impl/subject/adapter.hpp"

namespace nearmiss::adapters {

/// "major.minor.patch" of the headers that this program is compiled with.
inline std::string collide_version() {
  const auto part = [](int number) { return std::to_string(number); };
  return part(COLLIDE_VERSION_MAJOR) + '.' + part(COLLIDE_VERSION_MINOR) + '.' + part(COLLIDE_VERSION_PATCH);
}

/// One tier of `collide` in one scalar.
template <class Tier, class T>
struct Collide {
  using Number = T;
  static std::string version() { return collide_version(); }

  /// Contains the kernel, as in a program that inlines it: what is timed does not depend on the other queries in a
  /// source.
  template <class Q>
  [[gnu::flatten]] static typename Q::Answer answer(const Q& q) {
    return ask_collide<Tier>(q);
  }
  template <class Q>
  static collide::Contract contract() {
    return CollideFunction<Q>::template contract<Tier>();
  }
};

using CollideFastFloat = Collide<collide::Fast, float>;
using CollideFastDouble = Collide<collide::Fast, double>;
using CollideAccurateFloat = Collide<collide::Accurate, float>;
using CollideAccurateDouble = Collide<collide::Accurate, double>;

}  // namespace nearmiss::adapters
