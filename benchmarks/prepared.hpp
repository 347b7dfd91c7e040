/// Prepares operands before the timing, as a user would prepare and keep them.
#pragma once

#include <tuple>

#include "impl/adapters/collide_function.hpp"

namespace nearmiss::benchmarks {

/// The prepared arguments of a query.
template <class Tier, class Q>
struct Ready {
  explicit Ready(const Q& q) : arguments(adapters::arguments<Tier>(q)) {}
  /// The compiler decides only whether to inline the query itself: a call of this function would be timed too.
  [[gnu::always_inline]] auto ask() const noexcept {
    return std::apply(
        [](const auto&... a)
            __attribute__((always_inline)) { return adapters::CollideFunction<Q>::template call<Tier>(a...); },
        arguments);
  }
  decltype(adapters::arguments<Tier>(std::declval<Q>())) arguments;
};

}  // namespace nearmiss::benchmarks
