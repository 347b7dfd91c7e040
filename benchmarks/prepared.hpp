/// What a user prepares once and keeps, the benchmarks prepare before the question, too.
#pragma once

#include <tuple>

#include "impl/adapters/collide_function.hpp"

namespace nearmiss::benchmarks {

/// The inputs of a query as they are when the question comes.
template <class Tier, class Q>
struct Ready {
  explicit Ready(const Q& q) : arguments(adapters::arguments<Tier>(q)) {}
  auto ask() const noexcept {
    return std::apply([](const auto&... a) { return adapters::CollideFunction<Q>::template call<Tier>(a...); },
                      arguments);
  }
  decltype(adapters::arguments<Tier>(std::declval<Q>())) arguments;
};

}  // namespace nearmiss::benchmarks
