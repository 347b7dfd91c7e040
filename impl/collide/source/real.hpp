/// Exact real numbers, built from floating-point numbers by + - * / and square roots. Every comparison is exact.
#pragma once

#include <cstdint>
#include <limits>

#include <collide/detail/strict_begin.hpp>

namespace collide {

namespace detail {

/// A node of an expression (expression.hpp). It lives until clear_expressions().
struct Expression;
enum class ExpressionKind : std::uint8_t { leaf, sum, difference, product, quotient, root, infinite, invalid };

/// Ends the expressions of this thread. Their memory stays for the next ones.
void clear_expressions();

Expression& leaf_of(double x);
Expression& negative_of(Expression& a);
/// a + b, a - b, a b or a / b.
Expression& binary(ExpressionKind kind, Expression& a, Expression& b);
Expression& root_of(Expression& a);
/// -1, 0 or 1 for a < b, a == b, a > b; 2 if one of them is invalid.
int order(Expression& a, Expression& b);
/// The number within 2^-4 units in the last of `digits` binary places, or within 2^least; then rounded to double.
double rounded(Expression& e, int digits, double least);

}  // namespace detail

/// An exact real number, an infinity, or invalid (like NaN: every comparison is false). `Scalar` is the type of the
/// final answer: its largest finite number limits times. A number lives as long as the evaluation that made it.
template <class Scalar>
class Real {
 public:
  Real() : Real(0.0) {}
  Real(double x) : e_(&detail::leaf_of(x)) {}
  explicit Real(float x) : Real(double(x)) {}
  explicit Real(int x) : Real(double(x)) {}

  friend Real operator-(const Real& a) { return Real(detail::negative_of(*a.e_)); }
  friend Real operator+(const Real& a, const Real& b) { return of(detail::ExpressionKind::sum, a, b); }
  friend Real operator-(const Real& a, const Real& b) { return of(detail::ExpressionKind::difference, a, b); }
  friend Real operator*(const Real& a, const Real& b) { return of(detail::ExpressionKind::product, a, b); }
  friend Real operator/(const Real& a, const Real& b) { return of(detail::ExpressionKind::quotient, a, b); }
  Real& operator+=(const Real& b) { return *this = *this + b; }
  Real& operator-=(const Real& b) { return *this = *this - b; }
  Real& operator*=(const Real& b) { return *this = *this * b; }
  friend Real sqrt(const Real& a) { return Real(detail::root_of(*a.e_)); }
  friend Real abs(const Real& a) { return a < Real() ? -a : a; }

  friend bool operator<(const Real& a, const Real& b) { return order(a, b) == -1; }
  friend bool operator>(const Real& a, const Real& b) { return order(a, b) == 1; }
  friend bool operator==(const Real& a, const Real& b) { return order(a, b) == 0; }
  friend bool operator<=(const Real& a, const Real& b) {
    const int o = order(a, b);
    return o == -1 || o == 0;
  }
  friend bool operator>=(const Real& a, const Real& b) {
    const int o = order(a, b);
    return o == 1 || o == 0;
  }

  friend Real larger(const Real& a, const Real& b) { return a < b ? b : a; }
  friend Real smaller(const Real& a, const Real& b) { return b < a ? b : a; }

  /// The number rounded to Scalar. The error is below one unit in the last place, or below the smallest positive number
  /// of Scalar.
  Scalar rounded() const {
    constexpr int digits = std::numeric_limits<Scalar>::digits;
    constexpr double least = std::numeric_limits<Scalar>::min_exponent - digits - 3;  // log2
    return Scalar(detail::rounded(*e_, digits, least));
  }

 private:
  explicit Real(detail::Expression& e) : e_(&e) {}
  static Real of(detail::ExpressionKind kind, const Real& a, const Real& b) {
    return Real(detail::binary(kind, *a.e_, *b.e_));
  }
  static int order(const Real& a, const Real& b) { return detail::order(*a.e_, *b.e_); }

  detail::Expression* e_;
};

}  // namespace collide

template <class Scalar>
struct std::numeric_limits<collide::Real<Scalar>> {
  static constexpr bool is_specialized = true;
  static collide::Real<Scalar> infinity() { return std::numeric_limits<double>::infinity(); }
  static collide::Real<Scalar> quiet_NaN() { return std::numeric_limits<double>::quiet_NaN(); }
  static collide::Real<Scalar> max() { return double(std::numeric_limits<Scalar>::max()); }
};

#include <collide/detail/strict_end.hpp>
