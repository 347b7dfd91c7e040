/// What an adapter offers for one query.
#pragma once

#include <concepts>
#include <utility>

#include "impl/subject/adapter.hpp"
#include "impl/subject/subject.hpp"
#include "impl/subject/timed_calls.hpp"

namespace nearmiss {

/// The typed answer. Not inlined: the timed calls and the answers to the judge share one function.
template <class Adapter, class Q>
[[gnu::noinline]] auto typed_answer(const Q& q) {
  return Adapter::answer(q);
}

template <class Adapter, class Q>
Offering offering_of(std::string_view query) {
  Offering o;
  o.query = query;
  if constexpr (requires(const Q& q) { Adapter::answer(q); }) {
    o.offer = Offer::answers;
    o.answer = [](std::span<const double> values) {
      return erase(typed_answer<Adapter, Q>(inputs_from<Q>(values.data())));
    };
    o.time = [](const CaseNumbers& numbers, TimedRounds& rounds) {
      const std::vector<Q> cases = typed_cases<Q>(numbers);
      time_calls<Q>(cases, typed_answer<Adapter, Q>, rounds);
    };
    if constexpr (requires { Adapter::template contract<Q>(); }) o.contract = Adapter::template contract<Q>();
    if constexpr (requires { Adapter::template needs<Q>(); }) o.required = Adapter::template needs<Q>();
    if constexpr (requires { Adapter::template declares<Q>(); }) o.declare(Adapter::template declares<Q>());
    if constexpr (requires { Adapter::template equivalence<Q>(); }) {
      o.how = Adapter::template equivalence<Q>();
      if (!o.how.empty()) o.offer = Offer::by_equivalence;
    }
    if constexpr (requires { Adapter::template left_out<Q>(); }) {
      const std::string left_out = Adapter::template left_out<Q>();
      if (!left_out.empty()) o.how += (o.how.empty() ? "" : "; ") + ("without " + left_out);
    }
  } else {
    o.how = "the adapter has no function for it";
    if constexpr (requires { Adapter::template why_not<Q>(); }) o.how = Adapter::template why_not<Q>();
  }
  return o;
}

/// The subject without offerings.
template <class Adapter>
Subject without_offerings(std::string name) {
  static_assert(
      !requires { Adapter::referee; }, "a referee is added by nearmiss_add_subject with REFEREE");
  Subject s;
  s.name = std::move(name);
  s.version = Adapter::version();
  s.scalar = std::same_as<typename Adapter::Number, float> ? Scalar::float32 : Scalar::float64;
  return s;
}

/// The subject with one query alone.
template <class Adapter, class Q>
Subject bind_one(std::string name, std::string_view query) {
  Subject s = without_offerings<Adapter>(std::move(name));
  s.offerings.push_back(offering_of<Adapter, Q>(query));
  return s;
}

}  // namespace nearmiss
