/// The right answers, and the way of a mistake through the plugin's interface: once for each query.
#include "fuzz/planted/planting.hpp"
#include "impl/adapters/collide.hpp"
#include "impl/catalogue/answer.hpp"

namespace nearmiss::planted {

template <class Q>
typename Q::Answer right(const Q& q) {
  return adapters::ask_collide<collide::Accurate>(q);
}

template <class Q>
int answer_by(typename Q::Answer (*mistake)(Q), const double* numbers, nearmiss_answer* to) {
  const Answer a = erase(mistake(inputs_from<Q>(numbers)));
  to->yes = a.yes;
  std::copy_n(a.values.begin(), a.count, to->values);
  return NEARMISS_ANSWERED;
}

namespace {

template <class Q>
int answer_right(const double* numbers, std::size_t, nearmiss_answer* to) {
  return answer_by<Q>([](Q q) { return right(q); }, numbers, to);
}

template <class S>
int count_of_leaves() {
  S s{};
  int count = 0;
  collide::for_each_leaf(s, [&](const auto&, collide::Role) { ++count; });
  return count;
}

}  // namespace

template <class Q>
nearmiss_offer offer(const char* query, nearmiss_answer_function answer) {
  static const nearmiss_contract promise = [] {
    const collide::Contract c = adapters::CollideFunction<Q>::template contract<collide::Accurate>();
    return nearmiss_contract{c.backward, c.forward, c.unit, c.exact_decisions, c.lowest, c.highest};
  }();
  return {query, count_of_leaves<Q>(), count_of_leaves<typename Q::Answer>(), nullptr, &promise, answer, 0};
}

#define NEARMISS_QUERY(query)                                                                            \
  template inputs::query<double>::Answer right(const inputs::query<double>&);                            \
  template int answer_by<inputs::query<double>>(inputs::query<double>::Answer(*)(inputs::query<double>), \
                                                const double*, nearmiss_answer*);                        \
  template nearmiss_offer offer<inputs::query<double>>(const char*, nearmiss_answer_function);
#include "impl/catalogue/catalogue.def"
#undef NEARMISS_QUERY

nearmiss_answer_function right_answer_to(std::string_view query) {
#define NEARMISS_QUERY(name) \
  if (query == #name) return answer_right<inputs::name<double>>;
#include "impl/catalogue/catalogue.def"
#undef NEARMISS_QUERY
  return nullptr;
}

}  // namespace nearmiss::planted
