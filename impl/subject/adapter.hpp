/// The helpers of an adapter, which makes a library answer queries.
///
/// An adapter is a struct with a `static auto answer(const inputs::QUERY<Number>&)` for each
/// query that its library can answer. It returns the query's answer type, or one of the wrappers below.
#pragma once

#include <initializer_list>
#include <string>
#include <variant>

#include <collide/contract.hpp>

#include "impl/catalogue/answer.hpp"
#include "impl/catalogue/named_leaves.hpp"

namespace nearmiss {

/// The library has no answer to this case. The reason appears in reports. This is never counted as a miss.
struct CannotAnswer {
  std::string reason;
};

/// An answer of which only the decision and the named members are given.
template <class A>
struct Partly {
  A answer;
  std::uint64_t given = 0;
};

template <class A>
Partly<A> only(const A& answer, std::initializer_list<std::string_view> names) {
  Partly<A> p{answer};
  std::size_t i = 0;
  A walked = answer;
  for_each_named_leaf(walked, [&](const std::string& path, auto&, collide::Role) {
    for (std::string_view name : names) {
      if (path == name || path.starts_with(std::string(name) + ".")) p.given |= std::uint64_t{1} << i;
    }
    ++i;
  });
  return p;
}

template <class A>
using Reply = std::variant<A, Partly<A>, CannotAnswer>;

template <class A>
Answer erase(const Partly<A>& p) {
  Answer a = erase(p.answer);
  a.given = p.given;
  return a;
}
inline Answer erase(const Answer& a) { return a; }
inline Answer erase(const CannotAnswer& c) { return Answer::without(Answer::Status::cannot_answer, c.reason); }
template <class... As>
Answer erase(const std::variant<As...>& reply) {
  return std::visit([](const auto& r) { return erase(r); }, reply);
}

}  // namespace nearmiss
