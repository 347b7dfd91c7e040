/// Maps each query of the catalogue to its function in `collide` and the arguments of that function.
///
/// For each query, CMake writes nearmiss/collide_functions/QUERY.hpp. It includes the headers of the function and of
/// the inputs, collide_arguments/QUERY.hpp if there is one, and defines CollideFunction for the query. A source that
/// includes these headers for a few queries is compiled again only when one of those changes.
#pragma once

#include <tuple>

namespace nearmiss::adapters {

/// The function of `collide` with the query's name, and its contract.
template <class Q>
struct CollideFunction;

/// Defines CollideFunction for one query. Requires the headers of the query's function and of its inputs.
#define NEARMISS_COLLIDE_FUNCTION(query)                                              \
  template <class T>                                                                  \
  struct CollideFunction<inputs::query<T>> {                                          \
    template <class Tier, class... Arguments>                                         \
    [[gnu::always_inline]] static auto call(const Arguments&... arguments) noexcept { \
      return collide::query<Tier>(arguments...);                                      \
    }                                                                                 \
    template <class Tier>                                                             \
    static constexpr collide::Contract contract() {                                   \
      return collide::contracts::query<Tier, T>();                                    \
    }                                                                                 \
  };

/// The arguments of a query's function in a tuple: the members of the inputs. A specialization in
/// collide_arguments/QUERY.hpp prepares them where the function takes prepared ones.
template <class Q>
struct CollideArguments {
  template <class Tier>
  static auto of(const Q& q) noexcept {
    return std::apply([&](const auto&... member) { return std::tuple(q.*(member.pointer)...); }, Q::members());
  }
};
/// Defines CollideArguments for a query: expressions of its inputs `q`.
#define NEARMISS_COLLIDE_ARGUMENTS(query, ...)           \
  template <class T>                                     \
  struct CollideArguments<inputs::query<T>> {            \
    template <class Tier>                                \
    static auto of(const inputs::query<T>& q) noexcept { \
      return std::tuple(__VA_ARGS__);                    \
    }                                                    \
  };

template <class Tier, class Q>
auto arguments(const Q& q) noexcept {
  return CollideArguments<Q>::template of<Tier>(q);
}

/// The answer of `collide` in the tier.
template <class Tier, class Q>
auto ask_collide(const Q& q) noexcept {
  return std::apply([](const auto&... a) { return CollideFunction<Q>::template call<Tier>(a...); }, arguments<Tier>(q));
}

}  // namespace nearmiss::adapters
