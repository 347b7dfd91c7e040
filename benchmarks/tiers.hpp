/// The tiers of `collide` as contenders.
#pragma once

#include <collide/tiers.hpp>
#if __has_include(<collide/decisive.hpp>)
#include <collide/decisive.hpp>
#endif

#include "benchmarks/contender.hpp"
#include "benchmarks/prepared.hpp"

namespace nearmiss::benchmarks {

template <class Tier, class Q>
void enter_tier(const char* query, const char* tier) {
  register_contender(query, "collide", tier, std::make_unique<ContenderOf<Ready<Tier, Q>, Q, Tier>>());
}

template <class Q>
void enter_tiers(const char* query) {
  enter_tier<collide::Fast, Q>(query, "fast");
  enter_tier<collide::Accurate, Q>(query, "accurate");
#if __has_include(<collide/decisive.hpp>)
  enter_tier<collide::Decisive, Q>(query, "decisive");
  enter_tier<collide::Certified, Q>(query, "certified");
#endif
}

}  // namespace nearmiss::benchmarks
