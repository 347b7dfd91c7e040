/// The tiers `Fast` and `Accurate`: how much arithmetic a query spends on accuracy. A tier is a template argument of
/// every query. The third tier, `Certified`, has a header of its own (certified.hpp).
///
/// When to use which:
///   Fast       for everything that a wrong decision by rounding does not break: games, sampling, broad phases.
///   Accurate   where inputs are large or nearly degenerate: in float it computes in double, in double with compensated
///              sums of products.
///   Certified  where a decision must be the exact one: tests, geometry kernels, a referee. Needs GMP and MPFR.
/// docs: README.md of collide has the table with errors and times.
///
/// Each query has one kernel (detail/QUERY.hpp), the same in every tier. A tier calls the kernel in numbers and with an
/// arithmetic of its choice and rounds the answer; this is called lifting. So a kernel must be right in real numbers:
/// it uses + - * /, comparisons, sqrt, abs and the functions of detail/number.hpp, decides by comparisons alone, and
/// keeps guards against rounding, overflow and underflow behind `if constexpr (MachineNumber<T>)`.
///
/// Some queries have a second kernel in SIMD lanes (detail/lanes.hpp), which `Fast` uses where the machine has lanes,
/// and some a filter in doubles, which `Certified` tries first.
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

/// A number whose sign bit is set where x is NaN or infinite: an exponent of all ones carries into it.
template <MachineNumber T>
constexpr auto not_finite_bit(T x) {
  static_assert(sizeof(T) == 4 || sizeof(T) == 8);
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
  constexpr Bits exponent = std::bit_cast<Bits>(std::numeric_limits<T>::infinity());
  constexpr Bits one = Bits{1} << (std::numeric_limits<T>::digits - 1);
  return Bits((std::bit_cast<Bits>(x) & exponent) + one);
}

/// Whether every number of the arguments is finite. An argument that is a bare number may be +infinity.
template <class... Args>
constexpr bool all_finite(const Args&... args) {
  std::uint64_t bits = 0;  // in the sign bit of double, and in that of float
  const auto check = [&](const auto& argument) {
    if constexpr (MachineNumber<std::remove_cvref_t<decltype(argument)>>) {
      if (!(argument >= -std::numeric_limits<std::remove_cvref_t<decltype(argument)>>::max())) bits = ~std::uint64_t{0};
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

/// The answer to invalid input: no, a miss, or a depth that is NaN.
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

/// Turns a hit into a miss when any argument is not finite.
template <class A, class... Args>
constexpr void reject_nonfinite(A& answer, const Args&... args) {
  if constexpr (!requires { A::yes(); }) {
    if (answer.yes() && !all_finite(args...)) answer = answer_to_nonfinite<A>();
  }
}

/// Plain arithmetic in the caller's scalar.
struct Fast : Plain {
  /// Whether a query in this tier never throws.
  static constexpr bool never_throws = true;
  /// Whether the tier calls the kernel with arguments of T by its `lift`.
  template <class T>
  static constexpr bool lifts = MachineNumber<T>;

  /// Whether the tier computes in T itself, so that prepared inputs in T can help it.
  template <class T>
  static constexpr bool computes_in = true;

  /// Calls `kernel(arithmetic, arguments...)`.
  template <class F, class... Args>
  static constexpr auto lift(F&& kernel, const Args&... args) {
    auto answer = kernel(Plain{}, args...);
    reject_nonfinite(answer, args...);
    return answer;
  }
  /// The contract of a query in T whose contract in the fast tier is `fast`.
  template <class T>
  static constexpr Contract contract(const Contract& fast) {
    return fast;
  }
};

/// Whether a tier answers by the kernel in lanes, where a query has one.
template <class Tier, class T>
inline constexpr bool in_lanes = std::same_as<Tier, Fast> && MachineNumber<T>;

/// Whether a tier tries a query's filter, where the query has one, before it calls the kernel with error bounds.
template <class Tier, class T>
inline constexpr bool uses_filter = MachineNumber<T> && requires { Tier::decided_by_filter(true); };

/// After rounding: replaces a depth that became zero by the negative number next to zero where the answer is no, since
/// the sign of the depth is the decision.
template <class A>
constexpr void keep_sign_of_depth(bool yes, A& answer) {
  if constexpr (requires { answer.depth; }) {
    if (!yes && answer.yes()) answer.depth = -std::numeric_limits<decltype(answer.depth)>::denorm_min();
  }
}

/// In float: the kernel in double, its answer rounded once. In double: the kernel with compensated sums of products.
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
      reject_nonfinite(wide, args...);
      A answer{};
      convert(wide, answer, [](double from, float& to) { to = static_cast<float>(from); });
      keep_sign_of_depth(wide.yes(), answer);
      if constexpr (requires {
                      answer.time;
                      A::miss();
                    }) {
        if (wide.yes() && wide.time > double(std::numeric_limits<float>::max())) return A::miss();
      }
      return answer;
    } else {
      auto answer = kernel(Compensated{}, args...);
      reject_nonfinite(answer, args...);
      return answer;
    }
  }

  /// In float, the kernel's own errors are those of the fast tier in double, 2^-29 of a float's: the last rounding
  /// remains, and decisions within those errors. No product of eight floats leaves the range of double.
  template <class T>
  static constexpr Contract contract(const Contract& fast) {
    if constexpr (std::same_as<T, float>) return {.backward = 1, .unit = 4};
    return fast;
  }
};

}  // namespace collide

#include <collide/detail/strict_end.hpp>
