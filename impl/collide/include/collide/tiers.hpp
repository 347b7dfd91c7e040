/// The tiers `Fast` and `Accurate`. A tier fixes the precision, and so the cost, of a query; it is the first template
/// argument of every query. The tiers `Certified` and `Decisive` have headers of their own (certified.hpp,
/// decisive.hpp).
///
/// When to use which:
///   Fast       where a decision may go either way within the rounding error: games, sampling, broad phases.
///   Accurate   where inputs are large or nearly degenerate. For float it computes in double; for double it computes
///              sums of products that cancel in twice the precision.
///   Decisive   where every decision must be exact, and numbers may have the rounding errors of Fast.
///   Certified  where numbers must be accurate to the last place too: tests, geometry kernels,
///              reference results.
/// Decisive and Certified need the compiled library collide::certified, and it needs GMP and MPFR.
/// README.md of collide compares the tiers.
///
/// Each query has one kernel (detail/QUERY.hpp), which all tiers use. A tier converts the arguments to a number type,
/// calls the kernel with an arithmetic (detail/arithmetic.hpp), and rounds the answer; this is called lifting. A kernel
/// must therefore be correct over the real numbers: it uses + - * /, comparisons, sqrt, abs and the functions of
/// detail/number.hpp, and it decides by comparisons alone. Guards against rounding, overflow and underflow stand behind
/// `if constexpr (MachineNumber<T>)`.
///
/// Some queries have a second kernel in SIMD lanes (detail/lanes.hpp), which `Fast` uses on machines with lanes. Some
/// queries have a filter: a cheaper test in floating point that certifies its own answer or gives none. `Certified`
/// tries the filter first.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include <collide/answers.hpp>
#include <collide/contract.hpp>
#include <collide/detail/arithmetic.hpp>
#include <collide/detail/lanes.hpp>
#include <collide/detail/number.hpp>
#include <collide/vec3.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

/// An integer whose top bit is set exactly when x is NaN or infinite: adding 1 to an exponent of all ones carries into
/// the sign bit.
template <MachineNumber T>
constexpr auto not_finite_bit(T x) {
  static_assert(sizeof(T) == 4 || sizeof(T) == 8);
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
  constexpr Bits exponent = std::bit_cast<Bits>(std::numeric_limits<T>::infinity());
  constexpr Bits one = Bits{1} << (std::numeric_limits<T>::digits - 1);
  return Bits((std::bit_cast<Bits>(x) & exponent) + one);
}

/// False for a number that is NaN or -infinity.
template <class A>
constexpr bool is_limit(const A& argument) {
  if constexpr (MachineNumber<A>) return argument >= -std::numeric_limits<A>::max();
  return true;
}

/// all_finite() by the bits of each number.
template <class... Args>
COLLIDE_COLD constexpr bool each_is_finite(const Args&... args) {
  std::uint64_t bits = 0;  // in the sign bit of double, and in that of float
  const auto check = [&](const auto& argument) {
    if constexpr (MachineNumber<std::remove_cvref_t<decltype(argument)>>) {
      if (!is_limit(argument)) bits = ~std::uint64_t{0};
    } else {
      for_each_leaf(argument, [&](const auto& leaf, Role) {
        if constexpr (MachineNumber<std::remove_cvref_t<decltype(leaf)>>) bits |= not_finite_bit(leaf);
      });
    }
  };
  (check(args), ...);
  constexpr bool only_floats = (std::same_as<Rebound<Args, float>, Args> && ...);
  return (bits & (only_floats ? std::uint64_t{1} << 31 : std::uint64_t{1} << 63)) == 0;
}

/// The sum of the numbers in an argument; 0 for an argument that is itself a number.
template <class T, class A>
constexpr T sum_of_numbers(const A& argument) {
  T sum(-0.0);  // which compilers leave out
  if constexpr (!MachineNumber<A>) {
    for_each_leaf(argument, [&](const auto& leaf, Role) {
      if constexpr (MachineNumber<std::remove_cvref_t<decltype(leaf)>>) sum += T(leaf);
    });
  }
  return sum;
}

/// Whether every number in the arguments is finite. An argument that is itself a number, such as a time limit, may be
/// +infinity.
template <class... Args>
constexpr bool all_finite(const Args&... args) {
  using T = std::conditional_t<(std::same_as<Rebound<Args, float>, Args> && ...), float, double>;
  // A sum is finite only if every term is. One that is not may have overflowed.
  const T sum = (sum_of_numbers<T>(args) + ...);
  if (sum - sum == T(0)) [[likely]]
    return (... && is_limit(args));
  return each_is_finite(args...);
}

/// The answer for input that is not finite: no, a miss, or a depth of NaN.
template <class A>
constexpr A answer_to_nonfinite() {
  if constexpr (requires(A a) { a.depth; }) {
    A answer{};
    answer.depth = std::numeric_limits<decltype(answer.depth)>::quiet_NaN();
    return answer;
  } else {
    return A{};
  }
}

/// Replaces a yes by the answer for non-finite input when any argument is not finite. Answers that always say yes stay.
template <class A, class... Args>
constexpr void reject_nonfinite(A& answer, const Args&... args) {
  if constexpr (!requires { A::yes(); }) {
    if (answer.yes() && !all_finite(args...)) answer = answer_to_nonfinite<A>();
  }
}

/// A kernel that says yes only if every number in its arguments is finite, so that lifting needs no test of them: for
/// kernels so short that the test would cost as much as the answer.
template <class Kernel>
struct YesIfFinite : Kernel {
  static constexpr bool yes_if_finite = true;
};
template <class Kernel>
YesIfFinite(Kernel) -> YesIfFinite<Kernel>;

/// Replaces a yes by the answer for non-finite input when any argument is not finite, unless the kernel does so.
template <class Kernel, class A, class... Args>
constexpr void reject_nonfinite_of(A& answer, const Args&... args) {
  if constexpr (!requires { std::remove_cvref_t<Kernel>::yes_if_finite; }) reject_nonfinite(answer, args...);
}

/// Plain arithmetic in the caller's scalar. The fastest tier.
struct Fast : Plain {
  /// True if a query in this tier never throws.
  static constexpr bool never_throws = true;
  /// True if a query with arguments of T goes through `lift`; otherwise the kernel runs in T directly.
  template <class T>
  static constexpr bool lifts = MachineNumber<T>;

  /// True if the tier computes in T itself, so that it can use inputs prepared in T.
  template <class T>
  static constexpr bool computes_in = true;

  /// Calls `kernel(arithmetic, arguments...)` with the arithmetic and the numbers of this tier, and rounds the answer
  /// to T.
  template <class F, class... Args>
  static constexpr auto lift(F&& kernel, const Args&... args) {
    auto answer = kernel(Plain{}, args...);
    reject_nonfinite_of<F>(answer, args...);
    return answer;
  }
  /// The contract of a query in T, given its contract in the tier `Fast`.
  template <class T>
  static constexpr Contract contract(const Contract& fast) {
    return fast;
  }
};

/// True if the library collide::certified answers queries in the tier.
template <class Tier, class T>
inline constexpr bool is_compiled = MachineNumber<T> && requires { requires Tier::in_library; };

/// Declares, beside the kernel of a query, the function that the library has for float and for double
/// (source/queries.txt).
#define COLLIDE_COMPILED(query)                           \
  namespace compiled {                                    \
  template <class Answer, class Tier, class... Arguments> \
  Answer query(const Arguments&... arguments);            \
  }

/// The body of a query's function, whose scalar is T: the answer of the library or of the kernel in the tier.
#define COLLIDE_ANSWER(query, tier, ...)                                                    \
  if constexpr (is_compiled<tier, T>) {                                                     \
    return compiled::query<decltype(kernels::query<Fast>(__VA_ARGS__)), tier>(__VA_ARGS__); \
  } else                                                                                    \
    return kernels::query<tier>(__VA_ARGS__)

/// The kernel of a query as a function of the arithmetic, and its answer as `Tier` lifts it.
#define COLLIDE_KERNEL(query) \
  [](auto arithmetic, const auto&... a) { return kernels::query<decltype(arithmetic)>(a...); }
#define COLLIDE_LIFTED(query, ...) Tier::lift(COLLIDE_KERNEL(query), __VA_ARGS__)

/// True if the tier uses the kernel in SIMD lanes of queries that have one.
template <class Tier, class T>
inline constexpr bool in_lanes = std::same_as<Tier, Fast> && MachineNumber<T>;

/// True if the tier tries the filter of queries that have one before it calls the kernel.
template <class Tier, class T>
inline constexpr bool uses_filter = MachineNumber<T> && requires { Tier::decided_by_filter(true); };

namespace detail {
/// The tiers whose kernels answer queries in `Tier`: those with a decision, and those that always say yes. A tier that
/// leaves queries to others names both (decisive.hpp).
template <class Tier>
struct Answering {
  using Decisions = Tier;
  using Numbers = Tier;
};
template <class Tier>
  requires requires {
    typename Tier::Decisions;
    typename Tier::Numbers;
  }
struct Answering<Tier> {
  using Decisions = typename Tier::Decisions;
  using Numbers = typename Tier::Numbers;
};
}  // namespace detail
template <class Tier>
using TierOfDecisions = typename detail::Answering<Tier>::Decisions;
template <class Tier>
using TierOfNumbers = typename detail::Answering<Tier>::Numbers;

/// True if the tier takes the numbers of an answer from another tier than the one that decides: a query's kernel calls
/// that of TierOfNumbers, and that of TierOfDecisions where the decision of the answer is not certain.
template <class Tier, class T>
inline constexpr bool splits_answers = MachineNumber<T> && !std::same_as<Tier, TierOfNumbers<Tier>>;

/// `answer_in(tier)` for the tier of numbers, if `certain(answer)` tells that the decision of this answer is exact;
/// else for the tier of decisions.
template <class Tier, class AnswerIn, class Certain>
auto split_answer(const AnswerIn& answer_in, const Certain& certain) {
  const auto answer = answer_in(TierOfNumbers<Tier>{});
  return certain(answer) ? answer : answer_in(TierOfDecisions<Tier>{});
}

/// The sizes for which the bounds of `splits_answers` hold: no product overflows, and underflow costs less than a
/// rounding error.
template <class T>
constexpr bool is_moderate_size(T size) {
  constexpr T least = std::same_as<T, float> ? T(0x1p-30) : T(0x1p-400);
  return size >= least && size <= 1 / least;
}

/// Keeps the decision when a negative depth rounds to zero: replaces such a depth by the negative number nearest to
/// zero, since the sign of the depth is the decision. `yes` is the decision before rounding.
template <class A>
constexpr void keep_sign_of_depth(bool yes, A& answer) {
  if constexpr (requires { answer.depth; }) {
    if (!yes && answer.yes()) answer.depth = -std::numeric_limits<decltype(answer.depth)>::denorm_min();
  }
}

/// For float: runs the kernel in double and rounds the answer once. For double: runs the kernel with compensated sums
/// of products.
struct Accurate : Compensated {
  static constexpr bool never_throws = true;
  template <class T>
  static constexpr bool lifts = MachineNumber<T>;
  template <class T>
  static constexpr bool computes_in = std::same_as<T, double>;

  template <class F, class... Args>
  static constexpr auto lift(F&& kernel, const Args&... args) {
    using A = decltype(kernel(Plain{}, args...));
    if constexpr (std::same_as<A, Rebound<A, float>>) {
      const auto widened = [](const auto& argument) {
        Rebound<std::remove_cvref_t<decltype(argument)>, double> wide{};
        convert(argument, wide, [](float from, double& to) { to = from; });
        return wide;
      };
      auto wide = kernel(Plain{}, widened(args)...);
      reject_nonfinite_of<F>(wide, args...);
      A answer{};
      convert(wide, answer, [](double from, float& to) { to = static_cast<float>(from); });
      keep_sign_of_depth(wide.yes(), answer);
      if constexpr (requires { first_time(wide); }) {
        if (wide.yes() && first_time(wide) > double(std::numeric_limits<float>::max())) return A::miss();
      }
      return answer;
    } else {
      auto answer = kernel(Compensated{}, args...);
      reject_nonfinite_of<F>(answer, args...);
      return answer;
    }
  }

  /// For float, the kernel's errors are those of `Fast` in double, 2^-29 of a float's. What remains is the last
  /// rounding, and decisions within the kernel's errors. A product of eight floats stays in the range of double.
  template <class T>
  static constexpr Contract contract(const Contract& fast) {
    if constexpr (std::same_as<T, float>) return {.backward = 1, .unit = 4};
    return fast;
  }
};

}  // namespace collide

#include <collide/detail/strict_end.hpp>
