/// The operations, besides + - * / and comparisons, that kernels may use on a number. They have the same names for
/// float, double and every number type of the tiers.
#pragma once

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <array>
#include <concepts>
#include <limits>
#include <type_traits>

#include <collide/detail/machine_math.hpp>
#include <collide/members.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

/// True for the built-in floating-point types: they round, overflow and underflow.
template <class T>
concept MachineNumber = std::floating_point<T>;

namespace detail {
/// The next wider floating-point type.
template <MachineNumber T>
using Wider = std::conditional_t<std::same_as<T, float>, double, long double>;
/// Whether the wider type has at least ten more binary digits: on some machines long double is double.
template <MachineNumber T>
inline constexpr bool has_wider = std::numeric_limits<Wider<T>>::digits >= std::numeric_limits<T>::digits + 10;
}  // namespace detail

// Continuous functions: a number type with error bounds evaluates them without a decision. A NaN in the first argument
// is returned.

template <MachineNumber T>
constexpr T larger(T a, T b) {
#if defined(COLLIDE_SCALAR_INSTRUCTIONS)
  if constexpr (!std::same_as<T, long double>) {
    if (!std::is_constant_evaluated()) return detail::larger_at_run_time(a, b);
  }
#elif defined(__SSE2__)  // one instruction, where compilers often emit an unpredictable branch
  if (!std::is_constant_evaluated()) {
    if constexpr (std::same_as<T, double>) return _mm_cvtsd_f64(_mm_max_sd(_mm_set_sd(b), _mm_set_sd(a)));
    if constexpr (std::same_as<T, float>) return _mm_cvtss_f32(_mm_max_ss(_mm_set_ss(b), _mm_set_ss(a)));
  }
#endif
  return a < b ? b : a;
}
template <MachineNumber T>
constexpr T smaller(T a, T b) {
#if defined(COLLIDE_SCALAR_INSTRUCTIONS)
  if constexpr (!std::same_as<T, long double>) {
    if (!std::is_constant_evaluated()) return detail::smaller_at_run_time(a, b);
  }
#elif defined(__SSE2__)
  if (!std::is_constant_evaluated()) {
    if constexpr (std::same_as<T, double>) return _mm_cvtsd_f64(_mm_min_sd(_mm_set_sd(b), _mm_set_sd(a)));
    if constexpr (std::same_as<T, float>) return _mm_cvtss_f32(_mm_min_ss(_mm_set_ss(b), _mm_set_ss(a)));
  }
#endif
  return b < a ? b : a;
}

/// `x` if a < b, else `y`; branchless.
inline double if_less(double a, double b, double x, double y) {
#if defined(__SSE2__)
  const __m128d less = _mm_cmplt_sd(_mm_set_sd(a), _mm_set_sd(b));
  return _mm_cvtsd_f64(_mm_or_pd(_mm_and_pd(less, _mm_set_sd(x)), _mm_andnot_pd(less, _mm_set_sd(y))));
#else
  return a < b ? x : y;
#endif
}

/// x clamped to [low, high].
template <class T>
constexpr T clamped(const T& x, const T& low, const T& high) {
  return smaller(larger(x, low), high);
}

/// The larger of x and 0; NaN stays NaN.
template <class T>
constexpr T positive_part(const T& x) {
  return larger(x, T(0));
}

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
template <class X, int most, int least, class N>
struct Rebind<Counted<X, most, least>, N> {
  using type = Counted<typename Rebind<X, N>::type, most, least>;
};

}  // namespace detail

/// S with its number type replaced by N. S is a floating-point number, a listed struct or an array of them.
template <class S, class N>
using Rebound = typename detail::Rebind<S, N>::type;

/// Copies a number, a listed struct or an answer into one with another number type, each number by `number(from, to)`.
/// Flags, indices and counts are copied unchanged.
template <class From, class To, class F>
constexpr void convert(const From& from, To& to, F&& number) {
  if constexpr (Listed<From>) {
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      (convert(from.*(std::get<i>(From::members()).pointer), to.*(std::get<i>(To::members()).pointer), number), ...);
    }(std::make_index_sequence<std::tuple_size_v<decltype(From::members())>>());
    if constexpr (requires { From::decision_member(); }) to.*To::decision_member() = from.*From::decision_member();
  } else if constexpr (requires { from.begin(); }) {
    if constexpr (is_counted<From>) to.count = from.count;
    for (std::size_t i = 0; i < from.size(); ++i) convert(from[i], to[i], number);
  } else if constexpr (std::same_as<From, bool> || std::same_as<From, int>) {
    to = from;
  } else if constexpr (std::same_as<To, bool>) {  // a flag stored as a number with uncertain values
    to = !(from == From(0));
  } else {
    number(from, to);
  }
}

}  // namespace collide

#include <collide/detail/strict_end.hpp>
