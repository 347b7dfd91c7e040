/// The tiers of `collide` as contenders.
#pragma once

#include <collide/tiers.hpp>
#if __has_include(<collide/certified.hpp>)
#include <collide/certified.hpp>
#endif

#include "benchmarks/contender.hpp"

namespace nearmiss::benchmarks {

/// The inputs of a query, asked of one tier. Where the inputs have a `prepared()`, whose value answers by
/// `ask<Tier>()` too, that is done before.
template <class Tier, class Q>
struct TierScene {
  explicit TierScene(const Q& q) : inputs(prepared(q)) {}
  auto ask() const noexcept { return inputs.template ask<Tier>(); }

  static auto prepared(const Q& q) {
    if constexpr (requires { q.prepared(); }) {
      return q.prepared();
    } else {
      return q;
    }
  }
  decltype(prepared(Q{})) inputs;
};

template <class Tier, class Q>
void enter_tier(const char* query, const char* tier) {
  enter(query, "collide", tier, std::make_unique<ContenderOf<TierScene<Tier, Q>, Q>>());
}

template <class Q>
void enter_tiers(const char* query) {
  enter_tier<collide::Fast, Q>(query, "fast");
  enter_tier<collide::Accurate, Q>(query, "accurate");
#if __has_include(<collide/certified.hpp>)
  enter_tier<collide::Certified, Q>(query, "certified");
#endif
}

}  // namespace nearmiss::benchmarks
