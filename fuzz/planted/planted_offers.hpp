/// Offers of a plugin with planted mistakes: each query by its overload of mistake(), which is declared before.
#pragma once

#include <algorithm>
#include <iterator>

#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

template <class Q>
int answer(const double* numbers, nearmiss_answer* to) {
  const Answer a = erase(mistake(inputs_from<Q>(numbers)));
  to->yes = a.yes;
  std::copy_n(a.values.begin(), a.count, to->values);
  return NEARMISS_ANSWERED;
}

template <class Q>
nearmiss_contract contract() {
  const collide::Contract c = adapters::CollideFunction<Q>::template contract<collide::Accurate>();
  return {c.backward, c.forward, c.unit, c.exact_decisions, c.lowest, c.highest};
}

template <class S>
int count_of_leaves() {
  S s{};
  int count = 0;
  collide::for_each_leaf(s, [&](const auto&, collide::Role) { ++count; });
  return count;
}

template <class Q>
nearmiss_offer offer(const char* query) {
  static const nearmiss_contract promise = contract<Q>();
  return {query, count_of_leaves<Q>(), count_of_leaves<typename Q::Answer>(), nullptr, &promise, answer<Q>, 0};
}

}  // namespace
}  // namespace nearmiss::planted
