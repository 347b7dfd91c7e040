/// The offers and the entry of a plugin with planted mistakes: each query by its overload of mistake(), which is
/// declared before. NEARMISS_PLANTED_NAME is the plugin's name, NEARMISS_PLANTED_TABLE the file with its table of
/// mistakes.
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

extern "C" const nearmiss_plugin* nearmiss_plugin_entry() {
  using namespace nearmiss;
  static const nearmiss_offer offers[] = {
#define NEARMISS_PLANTED(query, where, mistake) planted::offer<inputs::query<double>>(#query),
#include NEARMISS_PLANTED_TABLE
#undef NEARMISS_PLANTED
  };
  static const nearmiss_plugin plugin{NEARMISS_PLUGIN_VERSION, NEARMISS_PLANTED_NAME, "1",
                                      NEARMISS_DOUBLE,         std::size(offers),     offers};
  return &plugin;
}
