/// Double-word arithmetic: a number as the unevaluated sum of two, with about twice the precision.
#pragma once

#include <limits>
#include <type_traits>

#include <collide/detail/machine_math.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

/// high + low with |low| <= ulp(high) / 2. Each operation has a relative error of at most DoubleWord<T>::epsilon unless
/// it overflows or underflows. Source: Joldes, Muller, Popescu, Tight and Rigorous Error Bounds for Basic Building
/// Blocks of Double-Word Arithmetic (2017): algorithms AccurateDWPlusDW (3 u^2) and DWTimesDW1 (7 u^2; 5 u^2 was proved
/// later), with u the unit roundoff of T.
template <class T>
struct DoubleWord {
  T high{}, low{};

  static constexpr T unit_roundoff = std::numeric_limits<T>::epsilon() / 2;
  static constexpr T epsilon = 8 * unit_roundoff * unit_roundoff;

  constexpr DoubleWord() = default;
  constexpr DoubleWord(T value) noexcept : high(value) {}
  constexpr DoubleWord(T h, T l) noexcept : high(h), low(l) {}

  static constexpr DoubleWord fast_two_sum(T a, T b) noexcept {
    const T s = a + b;
    return {s, b - (s - a)};
  }
  static constexpr DoubleWord two_sum(T a, T b) noexcept {
    const T s = a + b;
    const T b_part = s - a;
    return {s, (a - (s - b_part)) + (b - b_part)};
  }
  /// The exact product: by a fused multiply-add where the machine has one, else Dekker's product, which requires |a|
  /// and |b| below 2^(emax - digits/2).
  static constexpr DoubleWord two_product(T a, T b) noexcept {
#if defined(__FMA__)
    if (!std::is_constant_evaluated()) {
      const T product = a * b;
      return {product, detail::fma(a, b, -product)};
    }
#endif
    constexpr T splitter = T(1LL << ((std::numeric_limits<T>::digits + 1) / 2)) + T(1);
    const T ca = splitter * a, cb = splitter * b;
    const T ah = ca - (ca - a), bh = cb - (cb - b);
    const T al = a - ah, bl = b - bh;
    const T p = a * b;
    return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
  }

  friend constexpr DoubleWord operator+(const DoubleWord& a, const DoubleWord& b) noexcept {
    const DoubleWord s = two_sum(a.high, b.high), t = two_sum(a.low, b.low);
    const DoubleWord v = fast_two_sum(s.high, s.low + t.high);
    return fast_two_sum(v.high, t.low + v.low);
  }
  friend constexpr DoubleWord operator-(const DoubleWord& a) noexcept { return {-a.high, -a.low}; }
  friend constexpr DoubleWord operator-(const DoubleWord& a, const DoubleWord& b) noexcept { return a + -b; }
  friend constexpr DoubleWord operator*(const DoubleWord& a, const DoubleWord& b) noexcept {
    const DoubleWord p = two_product(a.high, b.high);
    return fast_two_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
  }
  /// Two steps of long division. The relative error is below 2^7 u^2: the quotient has two digits of 53 bits each; the
  /// remainder of the first has an error of 8 u^2 |a|, the remainder of the second is dropped.
  friend constexpr DoubleWord operator/(const DoubleWord& a, const DoubleWord& b) noexcept {
    const T first = a.high / b.high;
    const DoubleWord rest = a - b * DoubleWord(first);
    return fast_two_sum(first, rest.high / b.high);
  }
  /// One Newton step from the square root of the high part. The relative error is below 2^7 u^2.
  friend DoubleWord sqrt(const DoubleWord& a) noexcept {
    if (!(a.high > T(0))) return {detail::sqrt(a.high), T(0)};
    const T first = detail::sqrt(a.high);
    const DoubleWord rest = a - two_product(first, first);
    return fast_two_sum(first, rest.high / (T(2) * first));
  }
  friend constexpr bool operator==(const DoubleWord& a, const DoubleWord& b) noexcept {
    return a.high == b.high && a.low == b.low;
  }
  friend constexpr bool operator<=(const DoubleWord& a, const DoubleWord& b) noexcept { return !(b < a); }
  friend constexpr bool operator>=(const DoubleWord& a, const DoubleWord& b) noexcept { return !(a < b); }
  friend constexpr bool operator>(const DoubleWord& a, const DoubleWord& b) noexcept {
    return a.high > b.high || (a.high == b.high && a.low > b.low);
  }
  friend constexpr bool operator<(const DoubleWord& a, const DoubleWord& b) noexcept { return b > a; }
};

template <class T>
constexpr DoubleWord<T> abs(const DoubleWord<T>& a) noexcept {
  return a < DoubleWord<T>(T(0)) ? -a : a;
}

/// The cheapest number type with at least twice the precision of T, and its relative error per operation.
template <class T>
struct WideOf {
  using type = DoubleWord<T>;
  static constexpr T epsilon = DoubleWord<T>::epsilon;
};
template <>
struct WideOf<float> {
  using type = double;
  static constexpr float epsilon = 0x1p-53f;
};
template <class T>
using Wide = typename WideOf<T>::type;
template <class T>
inline constexpr T wide_epsilon = WideOf<T>::epsilon;

}  // namespace collide

#include <collide/detail/strict_end.hpp>
