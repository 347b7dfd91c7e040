/// What the texts of the queries may do with a number besides + - * / and comparing: the same words for
/// float, double and every number type of the tiers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>

#include <collide/members.hpp>

namespace collide {

/// True for the machine's own numbers: they round, overflow and underflow.
template <class T>
concept MachineNumber = std::floating_point<T>;

// Continuous functions, which a number type with error bounds evaluates without deciding anything. NaN in
// the first argument stays.

template <MachineNumber T>
constexpr T larger(T a, T b) noexcept { return a < b ? b : a; }
template <MachineNumber T>
constexpr T smaller(T a, T b) noexcept { return b < a ? b : a; }

/// x, or the nearer end of [low, high].
template <class T>
constexpr T clamped(const T& x, const T& low, const T& high) noexcept { return smaller(larger(x, low), high); }

/// x, or 0 where it is negative; NaN stays NaN.
template <class T>
constexpr T not_negative(const T& x) noexcept { return larger(x, T(0)); }

namespace detail {

template <class S, class N>
struct Rebind {  // flags and indices
  using type = S;
};
template <MachineNumber T, class N>
struct Rebind<T, N> {
  using type = N;
};
template <template <class> class S, class T, class N>
struct Rebind<S<T>, N> {
  using type = S<N>;
};
template <class X, std::size_t n, class N>
struct Rebind<std::array<X, n>, N> {
  using type = std::array<typename Rebind<X, N>::type, n>;
};

}  // namespace detail

/// The type of S, a machine number or a listed struct of them, with numbers of type N.
template <class S, class N>
using Rebound = typename detail::Rebind<S, N>::type;

/// Copies a number, or a listed struct or answer of numbers, into one with other numbers, each by
/// `number(from, to)`; flags and indices as they are.
template <class From, class To, class F>
constexpr void convert(const From& from, To& to, F&& number) {
  if constexpr (Listed<From>) {
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      (convert(from.*(std::get<i>(From::members()).pointer), to.*(std::get<i>(To::members()).pointer), number), ...);
    }(std::make_index_sequence<std::tuple_size_v<decltype(From::members())>>());
    if constexpr (requires { From::decision(); }) to.*To::decision() = from.*From::decision();
  } else if constexpr (requires { from.begin(); }) {
    for (std::size_t i = 0; i < from.size(); ++i) convert(from[i], to[i], number);
  } else if constexpr (std::same_as<From, bool> || std::same_as<From, int>) {
    to = from;
  } else {
    number(from, to);
  }
}

}  // namespace collide
