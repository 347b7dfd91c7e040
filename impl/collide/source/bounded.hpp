/// Numbers with error bounds: the first two stages of the tier Certified.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <collide/detail/double_word.hpp>
#include <collide/detail/number.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

/// Set by a comparison that the error bounds of its operands leave undecided, and by an operation whose error has no
/// bound. Everything computed after that may be wrong.
struct Doubt {
  static inline constinit thread_local bool any = false;
};

/// A double with a bound on its distance from the exact number. `Scalar` is the type of the final answer: its largest
/// finite number limits times.
///
/// The error bound of a result is the sum of the operation's own rounding error, 2^-53 |result|, and the propagated
/// errors of the operands. Magnitudes are those of the exact operands, at most |value| + error. The bound, multiplied
/// by u / 2^-53, also holds for the same operations in any arithmetic with a unit roundoff u below 2^-53. The proof is
/// by induction: each term below is linear in u or of higher order. The one exception is the rounding error of a sum:
/// the other arithmetic's sum differs by the errors of the operands, which adds 2^-53 of these errors. Bounds are sums
/// of products of nonnegative numbers, each with a relative error of 2^-50; `slack` covers more than a million such
/// steps and the exception above. The bounds do not hold for operations that underflow or overflow: the caller must
/// check the processor's flags.
template <class Scalar>
struct Bounded {
  double value = 0, error = 0;

  static constexpr double u = 0x1p-53, slack = 1 + 0x1p-30;

  constexpr Bounded() = default;
  constexpr Bounded(double v) noexcept : value(v) {}
  constexpr explicit Bounded(float v) noexcept : value(v) {}
  constexpr explicit Bounded(int v) noexcept : value(v) {}
  constexpr Bounded(double v, double e) noexcept : value(v), error(e) {}

  static double magnitude(double x) { return detail::abs(x); }

  // For detail/signed_distances.hpp.
  static constexpr bool only_proves = true;  ///< a search is left to numbers that have fewer doubts
  static bool& doubt() { return Doubt::any; }

  friend Bounded operator-(const Bounded& a) { return {-a.value, a.error}; }
  /// True if the compiler can prove that the number is exact, as inputs are. The terms of its error are then not
  /// computed.
  static bool is_exact(const Bounded& a) {
#if defined(__GNUC__)
    return __builtin_constant_p(a.error) && a.error == 0;
#else
    return false;
#endif
  }

  friend Bounded operator+(const Bounded& a, const Bounded& b) {
    const double sum = a.value + b.value, own = u * magnitude(sum);
    if (is_exact(a) && is_exact(b)) return {sum, own};
    if (is_exact(a)) return {sum, b.error + own};
    if (is_exact(b)) return {sum, a.error + own};
    return {sum, (a.error + b.error) + own};
  }
  friend Bounded operator-(const Bounded& a, const Bounded& b) { return a + -b; }
  friend Bounded operator*(const Bounded& a, const Bounded& b) {
    const double product = a.value * b.value, own = u * magnitude(product);
    if (is_exact(a) && is_exact(b)) return {product, own};
    if (is_exact(a)) return {product, magnitude(a.value) * b.error + own};
    if (is_exact(b)) return {product, magnitude(b.value) * a.error + own};
    return {product, (magnitude(a.value) + a.error) * b.error + (magnitude(b.value) + 2 * b.error) * a.error + own};
  }
  friend Bounded operator/(const Bounded& a, const Bounded& b) {
    const double quotient = a.value / b.value;
    const double least = magnitude(b.value) - 2 * b.error;
    if (!(least > 0)) Doubt::any = true;
    const double inverse = 1 / least;  // independent of the quotient, so that both divisions overlap
    return {quotient,
            (a.error + magnitude(quotient) * b.error) * inverse * (1 + 0x1p-20) + 2 * u * magnitude(quotient)};
  }
  Bounded& operator+=(const Bounded& b) { return *this = *this + b; }
  Bounded& operator-=(const Bounded& b) { return *this = *this - b; }
  Bounded& operator*=(const Bounded& b) { return *this = *this * b; }

  friend Bounded sqrt(const Bounded& a) {
    const double root = detail::sqrt(a.value);
    if (a.error == 0) return {root, u * root};
    if (!(a.value > 4 * a.error)) {
      Doubt::any = true;
      return {root, root};
    }
    const double inverse = 1 / a.value;  // independent of the root; a.error / root is twice the needed bound
    return {root, a.error * inverse * root + 2 * u * root};
  }
  friend Bounded abs(const Bounded& a) { return {detail::abs(a.value), a.error}; }

  /// The sum of both error bounds. A comparison of numbers closer than this is undecided. NaN if a bound is NaN.
  static double combined_error(const Bounded& a, const Bounded& b) { return (a.error + b.error) * slack; }

  friend bool operator<(const Bounded& a, const Bounded& b) {
    const double within = combined_error(a, b);
    if (!(magnitude(b.value - a.value) > within) && within != 0) Doubt::any = true;
    return a.value < b.value;
  }
  friend bool operator>(const Bounded& a, const Bounded& b) { return b < a; }
  friend bool operator<=(const Bounded& a, const Bounded& b) {
    const double within = combined_error(a, b);
    if (!(magnitude(b.value - a.value) > within) && within != 0) Doubt::any = true;
    return a.value <= b.value;
  }
  friend bool operator>=(const Bounded& a, const Bounded& b) { return b <= a; }
  friend bool operator==(const Bounded& a, const Bounded& b) {
    const double within = combined_error(a, b);
    if (!(magnitude(b.value - a.value) > within) && within != 0) Doubt::any = true;
    return a.value == b.value;
  }

  /// If the order of the two is undecided, each lies within the sum of both errors of the larger one.
  friend Bounded larger(const Bounded& a, const Bounded& b) {
    const double of_larger = if_less(a.value, b.value, b.error, a.error);
    return {collide::larger(a.value, b.value),
            if_less(combined_error(a, b), magnitude(b.value - a.value), of_larger, collide::larger(a.error, b.error))};
  }
  friend Bounded smaller(const Bounded& a, const Bounded& b) { return -larger(-a, -b); }
};

/// A number with an error bound, with a double-word as its value. Error terms vanish where an operation is exact, so
/// degenerate configurations of numbers with few bits are decided with certainty.
template <class Scalar>
struct WideBounded {
  using Value = DoubleWord<double>;
  Value value{};
  double error = 0;

  static constexpr double u = 0x1p-53, slack = 1 + 0x1p-30;

  constexpr WideBounded() = default;
  constexpr WideBounded(double v) noexcept : value(v) {}
  constexpr explicit WideBounded(float v) noexcept : value(double(v)) {}
  constexpr explicit WideBounded(int v) noexcept : value(double(v)) {}
  constexpr WideBounded(const Value& v, double e) noexcept : value(v), error(e) {}

  static double magnitude(double x) { return detail::abs(x); }
  static bool& doubt() { return Doubt::any; }  ///< for detail/signed_distances.hpp

  friend WideBounded operator-(const WideBounded& a) { return {-a.value, a.error}; }
  friend WideBounded operator+(const WideBounded& a, const WideBounded& b) {
    const Value high = Value::two_sum(a.value.high, b.value.high), low = Value::two_sum(a.value.low, b.value.low);
    const Value rest = Value::two_sum(high.low, low.high);
    const Value first = Value::two_sum(high.high, rest.high);
    const Value second = Value::two_sum(first.low, rest.low);
    const Value third = Value::two_sum(second.high, low.low);
    const Value sum = Value::fast_two_sum(first.high, third.high);
    return {sum, (a.error + b.error) + (magnitude(second.low) + magnitude(third.low))};
  }
  friend WideBounded operator-(const WideBounded& a, const WideBounded& b) { return a + -b; }
  friend WideBounded operator*(const WideBounded& a, const WideBounded& b) {
    const Value p = Value::two_product(a.value.high, b.value.high);
    const double inherited = (magnitude(a.value.high) * (1 + 2 * u) + a.error) * b.error +
                             (magnitude(b.value.high) * (1 + 2 * u) + b.error) * a.error;
    if (a.value.low == 0 && b.value.low == 0) return {p, inherited};
    const Value q = Value::two_product(a.value.high, b.value.low), r = Value::two_product(a.value.low, b.value.high);
    // The product is p.high + (p.low + q + r), up to the terms in `left`.
    const Value s = Value::two_sum(q.high, r.high), t = Value::two_sum(p.low, s.high);
    const Value product = Value::fast_two_sum(p.high, t.high);
    const double left = magnitude(t.low) + magnitude(s.low) + magnitude(q.low) + magnitude(r.low) +
                        magnitude(a.value.low * b.value.low);
    return {product, inherited + left};
  }
  friend WideBounded operator/(const WideBounded& a, const WideBounded& b) {
    const double least = magnitude(b.value.high) * (1 - 2 * u) - b.error;
    if (!(least > 0)) Doubt::any = true;
    // Two steps of long division, and the exact remainder of the second.
    const double first = a.value.high / b.value.high;
    const WideBounded rest = WideBounded(a.value, 0) - WideBounded(b.value, 0) * WideBounded(first);
    const double second = rest.value.high / b.value.high;
    const WideBounded last = rest - WideBounded(b.value, 0) * WideBounded(second);
    const Value quotient = Value::fast_two_sum(first, second);
    const double left = magnitude(last.value.high) * (1 + 2 * u) + last.error;
    return {quotient, (left + a.error + (magnitude(quotient.high) * (1 + 4 * u)) * b.error) / least * (1 + 0x1p-40)};
  }
  WideBounded& operator+=(const WideBounded& b) { return *this = *this + b; }
  WideBounded& operator-=(const WideBounded& b) { return *this = *this - b; }
  WideBounded& operator*=(const WideBounded& b) { return *this = *this * b; }

  friend WideBounded sqrt(const WideBounded& a) {
    if (a.value.high == 0 && a.error == 0) return a;
    if (!(a.value.high * (1 - 2 * u) > a.error)) {
      Doubt::any = true;
      return a;
    }
    const double first = detail::sqrt(a.value.high);
    const WideBounded rest = WideBounded(a.value, 0) - WideBounded(first) * WideBounded(first);
    const double second = rest.value.high / (2 * first);
    const Value root = Value::fast_two_sum(first, second);
    // The distance of `root` from the exact root of the value is |a - root^2| / (sqrt(a) + root).
    const WideBounded last = WideBounded(a.value, 0) - WideBounded(root, 0) * WideBounded(root, 0);
    const double left = magnitude(last.value.high) * (1 + 2 * u) + last.error;
    return {root, (left + a.error) / (first * (1 - 0x1p-40)) * (1 + 0x1p-40)};
  }
  friend WideBounded abs(const WideBounded& a) { return a.value.high < 0 ? -a : a; }

  /// -1, 0 or 1 for a < b, a == b, a > b. Records a doubt if the error bounds leave the order undecided.
  static int order(const WideBounded& a, const WideBounded& b) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (magnitude(a.value.high) == infinity || magnitude(b.value.high) == infinity) {
      return a.value.high < b.value.high ? -1 : a.value.high > b.value.high ? 1 : 0;
    }
    const WideBounded apart = a - b;
    const double d = apart.value.high;
    if (!(magnitude(d) * (1 - 4 * u) > apart.error * slack) && apart.error != 0) Doubt::any = true;
    return d < 0 ? -1 : d > 0 ? 1 : 0;
  }
  friend bool operator<(const WideBounded& a, const WideBounded& b) { return order(a, b) < 0; }
  friend bool operator>(const WideBounded& a, const WideBounded& b) { return order(a, b) > 0; }
  friend bool operator<=(const WideBounded& a, const WideBounded& b) { return order(a, b) <= 0; }
  friend bool operator>=(const WideBounded& a, const WideBounded& b) { return order(a, b) >= 0; }
  friend bool operator==(const WideBounded& a, const WideBounded& b) { return order(a, b) == 0; }

  friend WideBounded larger(const WideBounded& a, const WideBounded& b) {
    const bool doubt = Doubt::any;
    Doubt::any = false;
    WideBounded result = order(a, b) < 0 ? b : a;
    if (Doubt::any) result.error = std::max(a.error, b.error);
    Doubt::any = doubt;
    return result;
  }
  friend WideBounded smaller(const WideBounded& a, const WideBounded& b) { return -larger(-a, -b); }
};

}  // namespace collide

template <class Scalar>
struct std::numeric_limits<collide::Bounded<Scalar>> : std::numeric_limits<double> {
  static constexpr collide::Bounded<Scalar> infinity() { return std::numeric_limits<double>::infinity(); }
  static constexpr collide::Bounded<Scalar> quiet_NaN() { return std::numeric_limits<double>::quiet_NaN(); }
  static constexpr collide::Bounded<Scalar> max() { return double(std::numeric_limits<Scalar>::max()); }
};
template <class Scalar>
struct std::numeric_limits<collide::WideBounded<Scalar>> : std::numeric_limits<double> {
  static constexpr collide::WideBounded<Scalar> infinity() { return std::numeric_limits<double>::infinity(); }
  static constexpr collide::WideBounded<Scalar> quiet_NaN() { return std::numeric_limits<double>::quiet_NaN(); }
  static constexpr collide::WideBounded<Scalar> max() { return double(std::numeric_limits<Scalar>::max()); }
};

#include <collide/detail/strict_end.hpp>
