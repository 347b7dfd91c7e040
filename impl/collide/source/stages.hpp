/// The stages of the tier `Certified` (collide/certified.hpp).
///
/// The kernel of a query runs in up to three stages: in doubles with error bounds (bounded.hpp), in double-words with
/// error bounds, and in exact real numbers (real.hpp). A stage's answer is used if no comparison was in doubt and every
/// number is accurate enough. The last stage always succeeds.
#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define COLLIDE_SANITIZED
#endif
#endif

#include <algorithm>
#include <cfenv>
#include <cstdint>

#include <collide/certified.hpp>
#include <collide/decisive.hpp>
#include <collide/detail/wide_filters.hpp>

#include "bounded.hpp"
#include "real.hpp"

// Arithmetic with bounds is fast only if the whole kernel is inlined into one function: the compiler then sees which
// numbers are exact and drops their error terms. Under a sanitizer this is turned off: it instruments each operation,
// and compilation would take very long.
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && !defined(COLLIDE_SANITIZED)
#define COLLIDE_FLATTEN [[gnu::noinline, gnu::flatten]]
#else
#define COLLIDE_FLATTEN [[gnu::noinline]]
#endif

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// The counts of Certified::counts().
extern constinit thread_local StageCounts stage_counts;

// The processor's floating-point flags are read after the arithmetic that sets them. A compiler does not know this
// dependence and may move arithmetic across the clearing and the reading of the flags. Two optimization barriers
// prevent that: `make_opaque` forces operands to be loaded after the clearing, `force_evaluation` forces results to be
// computed before the reading.

/// Optimization barrier: the compiler must assume that the numbers of `x` may have changed here.
template <class X>
void make_opaque(const X& x) {
#if defined(__GNUC__)
  asm volatile("" : : "r"(&x) : "memory");
#else
  static_cast<void>(*reinterpret_cast<const volatile char*>(&x));
#endif
}

/// Optimization barrier: `x`, and everything stored to memory, is computed before this point.
inline void force_evaluation(double x) {
#if defined(__GNUC__) && defined(__SSE2__)
  asm volatile("" : : "x"(x) : "memory");
#elif defined(__GNUC__)
  asm volatile("" : : "m"(x) : "memory");
#else
  const volatile double evaluated = x;
  static_cast<void>(evaluated);
#endif
}
inline void force_evaluation(const DoubleWord<double>& x) { force_evaluation(x.high), force_evaluation(x.low); }
inline void force_evaluation(int x) {
#if defined(__GNUC__)
  asm volatile("" : : "r"(x) : "memory");
#else
  const volatile int evaluated = x;
  static_cast<void>(evaluated);
#endif
}

/// Tells whether an operation overflowed or underflowed between construction and the completed answer. If so, the error
/// bounds are invalid.
class RangeFlags {
 public:
  template <class... Args>
  explicit RangeFlags(const Args&... args) {
    clear();
    (make_opaque(args), ...);
  }
  template <class A>
  bool raised_for(const A& answer) const {
    if constexpr (requires { A::decision_member(); }) force_evaluation(int(answer.*A::decision_member()));
    for_each_leaf(answer, [](const auto& leaf, Role) {
      if constexpr (requires { leaf.error; }) {
        force_evaluation(leaf.value), force_evaluation(leaf.error);
      } else if constexpr (std::same_as<std::remove_cvref_t<decltype(leaf)>, double>) {
        force_evaluation(leaf);
      } else {
        force_evaluation(int(leaf));
      }
    });
    return raised();
  }

 private:
#if defined(__SSE2__)
  static constexpr unsigned mask = 0x08 | 0x10;  // overflow, underflow
  static void clear() {
    const unsigned state = _mm_getcsr();
    if ((state & mask) != 0) _mm_setcsr(state & ~mask);
  }
  static bool raised() { return (_mm_getcsr() & mask) != 0; }
#else
  static void clear() { std::feclearexcept(FE_OVERFLOW | FE_UNDERFLOW); }
  static bool raised() { return std::fetestexcept(FE_OVERFLOW | FE_UNDERFLOW) != 0; }
#endif
};

/// A number of higher precision without error bounds. The error bounds of Bounded hold for the same operations in this
/// type, multiplied by the ratio of the unit roundoffs. `M` is long double where that has 64 bits, or a double-word.
template <class Scalar, class M>
struct HighPrecision {
  static constexpr bool follows_decisions = true;  ///< of Bounded, without doubt (signed_distances.hpp)
  M value{};

  constexpr HighPrecision() = default;
  constexpr HighPrecision(double v) noexcept : value(v) {}
  constexpr explicit HighPrecision(float v) noexcept : value(double(v)) {}
  constexpr explicit HighPrecision(int v) noexcept : value(double(v)) {}
  static constexpr HighPrecision of(const M& v) {
    HighPrecision x;
    x.value = v;
    return x;
  }

  friend HighPrecision operator-(const HighPrecision& a) { return of(-a.value); }
  friend HighPrecision operator+(const HighPrecision& a, const HighPrecision& b) { return of(a.value + b.value); }
  friend HighPrecision operator-(const HighPrecision& a, const HighPrecision& b) { return of(a.value - b.value); }
  friend HighPrecision operator*(const HighPrecision& a, const HighPrecision& b) { return of(a.value * b.value); }
  friend HighPrecision operator/(const HighPrecision& a, const HighPrecision& b) { return of(a.value / b.value); }
  HighPrecision& operator+=(const HighPrecision& b) { return *this = *this + b; }
  HighPrecision& operator-=(const HighPrecision& b) { return *this = *this - b; }
  HighPrecision& operator*=(const HighPrecision& b) { return *this = *this * b; }
  friend HighPrecision sqrt(const HighPrecision& a) {
    using detail::sqrt;
    return of(sqrt(a.value));
  }
  friend HighPrecision abs(const HighPrecision& a) {
    using detail::abs;
    return of(abs(a.value));
  }
  friend bool operator<(const HighPrecision& a, const HighPrecision& b) { return a.value < b.value; }
  friend bool operator>(const HighPrecision& a, const HighPrecision& b) { return a.value > b.value; }
  friend bool operator<=(const HighPrecision& a, const HighPrecision& b) { return a.value <= b.value; }
  friend bool operator>=(const HighPrecision& a, const HighPrecision& b) { return a.value >= b.value; }
  friend bool operator==(const HighPrecision& a, const HighPrecision& b) { return a.value == b.value; }
  friend HighPrecision larger(const HighPrecision& a, const HighPrecision& b) { return a.value < b.value ? b : a; }
  friend HighPrecision smaller(const HighPrecision& a, const HighPrecision& b) { return b.value < a.value ? b : a; }
};

inline constexpr bool has_long_double = std::numeric_limits<long double>::digits == 64;
inline constexpr double long_double_ratio = 0x1p-11;  // unit roundoff 2^-64 against 2^-53
inline constexpr double double_word_ratio = 0x1p-46;  // unit roundoff 2^-99 against 2^-53
inline double rounded(long double x) { return double(x); }
inline double rounded(const DoubleWord<double>& x) { return x.high; }

template <class S>
struct AnswerOver;
template <template <class> class S, class T>
struct AnswerOver<S<T>> {
  using Scalar = T;
};

/// The argument converted to numbers of type N.
template <class N, class Argument>
auto widened(const Argument& argument) {
  Rebound<Argument, N> wide{};
  convert(argument, wide, [](const auto& from, N& to) { to = N(double(from)); });
  return wide;
}

/// Turns an impact at a time beyond the largest finite scalar into a miss.
template <class N, class A>
void miss_beyond_range(A& answer) {
  if constexpr (requires {
                  A::miss();
                  answer.time;
                }) {
    if (answer.time < std::numeric_limits<N>::infinity() && answer.time > std::numeric_limits<N>::max()) {
      answer = A::miss();
    }
  }
}

/// The largest allowed error of a number before rounding: half a unit in the last place of the largest number of its
/// member. The final rounding takes at most another half.
template <class T>
double allowed_error(double largest) {
  constexpr double least = std::numeric_limits<T>::min();
  return std::max(largest, least) * (double(std::numeric_limits<T>::epsilon()) / 4);
}

/// Whether the numbers of a quantity or an answer are accurate enough: as computed, or after a second computation in
/// long double or in double-words, or not even then.
enum class Accuracy { insufficient, needs_double_words, needs_long_double, sufficient };

/// The accuracy of one quantity (a time, a point, a vector) over Bounded or WideBounded, for results in T. An infinity,
/// and an exact number that T represents, is sufficient.
template <class T, class Quantity>
Accuracy accuracy_of_quantity(const Quantity& quantity) {
  double largest = 0, error = 0;
  for_each_leaf(quantity, [&](const auto& leaf, Role) {
    if constexpr (requires { leaf.error; }) {
      largest = std::max(largest, detail::abs(leading_part(leaf.value)));
      error = leaf.error <= error ? error : leaf.error;  // NaN stays
    }
  });
  const double most = allowed_error<T>(largest), needed = error * (1 + 0x1p-20);
  if (needed <= most) return Accuracy::sufficient;
  bool all = true;
  for_each_leaf(quantity, [&](const auto& leaf, Role) {
    if constexpr (requires { leaf.error; }) {
      const double value = leading_part(leaf.value);
      if (leaf.error != 0 || !(double(T(value)) == value || std::isinf(value))) all = false;
    }
  });
  if (all) return Accuracy::sufficient;
  if (has_long_double && needed * long_double_ratio <= most) return Accuracy::needs_long_double;
  return needed * double_word_ratio <= most ? Accuracy::needs_double_words : Accuracy::insufficient;
}

/// The accuracy of a whole answer. A member without a role of its own consists of several quantities.
template <class T, class A>
Accuracy accuracy_of(const A& answer, Role role = Role::inherited) {
  if constexpr (Listed<A> || requires { answer.begin(); }) {
    if (role == Role::inherited) {
      Accuracy all = Accuracy::sufficient;
      if constexpr (Listed<A>) {
        for_each_member(answer, [&](const char*, const auto& member, Role own) {
          all = std::min(all, accuracy_of<T>(member, own));
        });
      } else {
        for (const auto& item : answer) all = std::min(all, accuracy_of<T>(item, role));
      }
      return all;
    }
  }
  return accuracy_of_quantity<T>(answer);
}

}  // namespace detail

/// The tier `Certified` with its stages: the library computes in this tier what it declares in that one.
struct CertifiedInStages : Plain {
  static constexpr bool never_throws = false;
  template <class T>
  static constexpr bool lifts = MachineNumber<T>;
  template <class T>
  static constexpr bool computes_in = false;

  /// Counts and returns an answer that a query's own filter decided.
  template <class A>
  static A decided_by_filter(const A& answer) {
    ++detail::stage_counts.filter;
    return answer;
  }

  template <class F, class... Args>
  static auto lift(F&& kernel, const Args&... args) {
    using Answer = decltype(kernel(Plain{}, args...));
    using T = typename detail::AnswerOver<Answer>::Scalar;
    Answer answer{};
    if (filtered<T>(answer, kernel, args...)) {
      ++detail::stage_counts.filter;
    } else if (extended<T>(answer, kernel, args...)) {
      ++detail::stage_counts.extended;
    } else {
      exact<T>(answer, kernel, args...);
    }
    reject_nonfinite(answer, args...);
    return answer;
  }

 private:
  template <class T, class F, class... Args>
  COLLIDE_FLATTEN static bool filtered(auto& answer, F& kernel, const Args&... args) {
    using N = Bounded<T>;
    const detail::RangeFlags range(args...);
    Doubt::any = false;
    auto wide = kernel(Plain{}, detail::widened<N>(args)...);
    detail::miss_beyond_range<N>(wide);
    const bool yes = wide.yes();
    if (range.raised_for(wide) || Doubt::any) return false;
    const detail::Accuracy accuracy = detail::accuracy_of<T>(wide);
    if (accuracy == detail::Accuracy::sufficient) {
      convert(wide, answer, [](const N& from, T& to) { to = T(from.value); });
      keep_sign_of_depth(yes, answer);
      return true;
    }
    if constexpr (std::same_as<T, double>) {  // every decision is certain: only more digits are needed
      if constexpr (detail::has_long_double) {
        if (accuracy == detail::Accuracy::needs_long_double) {
          in_long_double<T>(yes, answer, kernel, args...);
          return true;
        }
      }
      if (accuracy == detail::Accuracy::needs_double_words) {
        return in_double_words<T>(yes, answer, kernel, args...);
      }
    }
    return false;
  }

  template <class T, class F, class... Args>
  COLLIDE_FLATTEN static void in_long_double(bool yes, auto& answer, F& kernel, const Args&... args) {
    in_high_precision<T, detail::HighPrecision<T, long double>>(yes, answer, kernel, args...);
  }
  template <class T, class F, class... Args>
  [[gnu::noinline]] static bool in_double_words(bool yes, auto& answer, F& kernel, const Args&... args) {
    const detail::RangeFlags range(args...);
    in_high_precision<T, detail::HighPrecision<T, DoubleWord<double>>>(yes, answer, kernel, args...);
    return !range.raised_for(answer);
  }
  template <class T, class N, class F, class... Args>
  static void in_high_precision(bool yes, auto& answer, F& kernel, const Args&... args) {
    const auto wide = kernel(Plain{}, detail::widened<N>(args)...);
    convert(wide, answer, [](const N& from, T& to) { to = detail::rounded(from.value); });
    keep_sign_of_depth(yes, answer);
  }

  template <class T, class F, class... Args>
  [[gnu::noinline]] static bool extended(auto& answer, F& kernel, const Args&... args) {
    using N = WideBounded<T>;
    const detail::RangeFlags range(args...);
    Doubt::any = false;
    auto wide = kernel(Plain{}, detail::widened<N>(args)...);
    detail::miss_beyond_range<N>(wide);
    const bool yes = wide.yes();
    if (range.raised_for(wide) || Doubt::any || detail::accuracy_of<T>(wide) != detail::Accuracy::sufficient)
      return false;
    convert(wide, answer, [](const N& from, T& to) { to = T(from.value.high); });
    keep_sign_of_depth(yes, answer);
    return true;
  }

  template <class T, class F, class... Args>
  [[gnu::noinline]] static void exact(auto& answer, F& kernel, const Args&... args) {
    using N = Real<T>;
    if (!all_finite(args...)) {
      ++detail::stage_counts.invalid;
      answer = kernel(Plain{}, args...);
      return;
    }
    ++detail::stage_counts.exact;
    const struct ClearAtEnd {
      ~ClearAtEnd() { detail::clear_expressions(); }
    } clear_at_end;
    auto wide = kernel(Plain{}, detail::widened<N>(args)...);
    detail::miss_beyond_range<N>(wide);
    convert(wide, answer, [](const N& from, T& to) { to = from.rounded(); });
    keep_sign_of_depth(wide.yes(), answer);
  }
};

/// The tier `Decisive` with the stages of `Certified`.
struct DecisiveInStages : CertifiedInStages {
  using Decisions = CertifiedInStages;
  using Numbers = Fast;
};

/// The tier with stages in which the library answers in `Tier`.
template <class Tier>
using InStages = std::conditional_t<std::same_as<Tier, Decisive>, DecisiveInStages, CertifiedInStages>;

}  // namespace collide

template <class Scalar, class M>
struct std::numeric_limits<collide::detail::HighPrecision<Scalar, M>> : std::numeric_limits<double> {
  using Number = collide::detail::HighPrecision<Scalar, M>;
  static constexpr Number infinity() { return std::numeric_limits<double>::infinity(); }
  static constexpr Number quiet_NaN() { return std::numeric_limits<double>::quiet_NaN(); }
  static constexpr Number max() { return double(std::numeric_limits<Scalar>::max()); }
};

#include <collide/detail/strict_end.hpp>
