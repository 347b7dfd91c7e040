/// Exact real numbers, built from floating-point numbers by + - * / and square roots. Every comparison is exact. Needs
/// MPFR and GMP (target collide::certified).
#pragma once

#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <collide/detail/constructible.hpp>
#include <collide/detail/number.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// The precision, in bits, of the first and the last interval evaluation of a sign before the exact computation.
inline constexpr mpfr_prec_t least_precision = 128, most_precision = 512;

/// A closed interval with multiple-precision bounds. Up to `most_precision` bits it needs no memory but its own.
class BigInterval {
 public:
  BigInterval() = default;
  ~BigInterval() { release(); }
  BigInterval(const BigInterval&) = delete;
  BigInterval& operator=(const BigInterval&) = delete;

  /// Sets the precision; the value is lost.
  void set_precision(mpfr_prec_t precision) {
    release();
    if (precision <= most_precision) {
      (mpfr_custom_init_set)(low, MPFR_NAN_KIND, 0, precision, limbs_[0]);
      (mpfr_custom_init_set)(high, MPFR_NAN_KIND, 0, precision, limbs_[1]);
    } else {
      mpfr_inits2(precision, low, high, static_cast<mpfr_ptr>(nullptr));
    }
    precision_ = precision;
  }
  /// 0: no value.
  mpfr_prec_t precision() const { return precision_; }
  /// Gives back the value and its memory.
  void release() {
    if (precision_ > most_precision) mpfr_clears(low, high, static_cast<mpfr_ptr>(nullptr));
    precision_ = 0;
  }
  /// -1 or 1 if all numbers of the interval have that sign; 0 for [0, 0]; 2 if the sign is not known.
  int sign() const {
    const int l = mpfr_sgn(low), h = mpfr_sgn(high);
    return l > 0 ? 1 : h < 0 ? -1 : l == 0 && h == 0 ? 0 : 2;
  }

  mpfr_t low, high;

 private:
  mpfr_prec_t precision_ = 0;
  mp_limb_t limbs_[2][(most_precision + GMP_NUMB_BITS - 1) / GMP_NUMB_BITS];
};

/// result = x y, rounded outward to the precision of `result`, which is neither x nor y.
inline void multiply(BigInterval& result, const BigInterval& x, const BigInterval& y) {
  const auto of_one_sign = [](const BigInterval& z) { return mpfr_sgn(z.low) >= 0 || mpfr_sgn(z.high) <= 0; };
  if (!of_one_sign(y) && of_one_sign(x)) return multiply(result, y, x);
  if (!of_one_sign(y)) {  // each bound is the extreme one of two products
    BigInterval other;
    other.set_precision(result.precision());
    mpfr_mul(result.low, x.low, y.high, MPFR_RNDD);
    mpfr_mul(other.low, x.high, y.low, MPFR_RNDD);
    mpfr_min(result.low, result.low, other.low, MPFR_RNDD);
    mpfr_mul(result.high, x.low, y.low, MPFR_RNDU);
    mpfr_mul(other.high, x.high, y.high, MPFR_RNDU);
    mpfr_max(result.high, result.high, other.high, MPFR_RNDU);
    return;
  }
  const bool positive = mpfr_sgn(y.low) >= 0;
  const mpfr_t &least = positive ? x.low : x.high, &largest = positive ? x.high : x.low;
  mpfr_mul(result.low, least, mpfr_sgn(least) >= 0 ? y.low : y.high, MPFR_RNDD);
  mpfr_mul(result.high, largest, mpfr_sgn(largest) >= 0 ? y.high : y.low, MPFR_RNDU);
}

/// result = x / y, rounded outward; y does not contain 0, and `result` is neither x nor y.
inline void divide(BigInterval& result, const BigInterval& x, const BigInterval& y) {
  const bool positive = mpfr_sgn(y.low) > 0;
  const mpfr_t &least = positive ? x.low : x.high, &largest = positive ? x.high : x.low;
  mpfr_div(result.low, least, mpfr_sgn(least) >= 0 ? y.high : y.low, MPFR_RNDD);
  mpfr_div(result.high, largest, mpfr_sgn(largest) >= 0 ? y.low : y.high, MPFR_RNDU);
}

/// A node of an expression. Its sign is found by interval evaluation in increasing precision; if the interval still
/// contains zero at the highest one, the value is computed exactly, in a tower of square roots (constructible.hpp).
struct Expression {
  enum class Kind : std::uint8_t { leaf, sum, difference, product, quotient, root, infinite, invalid };

  Kind kind = Kind::invalid;
  std::int8_t known_sign = 2;  // 2: not yet known
  double leaf = 0;
  Expression *a = nullptr, *b = nullptr;
  BigInterval value;
  std::optional<Constructible> exact;
};

/// The expressions of one evaluation, and the square roots of its exact values. They live until the evaluation clears
/// them. Their memory stays for the next evaluation, up to `most_kept` expressions.
class Expressions {
 public:
  static Expressions& of_this_thread() {
    static thread_local Expressions all;
    return all;
  }
  Expression& make(Expression::Kind kind, Expression* a = nullptr, Expression* b = nullptr) {
    if (used_ == blocks_.size() * block) blocks_.push_back(std::make_unique<Expression[]>(block));
    Expression& e = at(used_++);
    e.kind = kind;
    e.known_sign = 2;
    e.a = a;
    e.b = b;
    return e;
  }
  Roots& roots() { return roots_; }
  void clear() {
    for (std::size_t i = 0; i < used_; ++i) {
      at(i).value.release();
      at(i).exact.reset();
    }
    used_ = 0;
    if (blocks_.size() > most_kept / block) blocks_.resize(most_kept / block);
    roots_.clear();
  }

 private:
  static constexpr std::size_t block = 64, most_kept = 4096;
  Expression& at(std::size_t i) { return blocks_[i / block][i % block]; }

  std::vector<std::unique_ptr<Expression[]>> blocks_;
  std::size_t used_ = 0;
  Roots roots_;
};

using ExpressionKind = Expression::Kind;

inline bool is_number(const Expression& e) {
  return e.kind != ExpressionKind::invalid && e.kind != ExpressionKind::infinite;
}
int sign_of(Expression& e);

inline Expression& leaf_of(double x) {
  if (x != x) return Expressions::of_this_thread().make(ExpressionKind::invalid);
  if (std::isinf(x)) {
    Expression& e = Expressions::of_this_thread().make(ExpressionKind::infinite);
    e.leaf = x;
    return e;
  }
  Expression& e = Expressions::of_this_thread().make(ExpressionKind::leaf);
  e.leaf = x;
  e.known_sign = x > 0 ? 1 : x < 0 ? -1 : 0;
  return e;
}

inline Expression& binary(ExpressionKind kind, Expression& a, Expression& b) {
  Expressions& all = Expressions::of_this_thread();
  if (!is_number(a) || !is_number(b)) return all.make(ExpressionKind::invalid);
  const bool sum = kind == ExpressionKind::sum, difference = kind == ExpressionKind::difference;
  if ((sum || difference) && b.known_sign == 0) return a;
  if (sum && a.known_sign == 0) return b;
  if (kind == ExpressionKind::product && (a.known_sign == 0 || b.known_sign == 0)) return leaf_of(0);
  if (kind == ExpressionKind::product && a.kind == ExpressionKind::leaf && a.leaf == 1) return b;
  if (kind == ExpressionKind::product && b.kind == ExpressionKind::leaf && b.leaf == 1) return a;
  if (kind == ExpressionKind::quotient) {
    if (sign_of(b) == 0) return all.make(ExpressionKind::invalid);
    if (a.known_sign == 0) return a;
  }
  Expression& e = all.make(kind, &a, &b);
  if (a.known_sign == 2 || b.known_sign == 2) return e;
  if (sum || difference) {
    const int sign_b = difference ? -b.known_sign : b.known_sign;
    if (a.known_sign == sign_b || a.known_sign == 0) e.known_sign = std::int8_t(sign_b);
  } else {
    e.known_sign = std::int8_t(a.known_sign * b.known_sign);
  }
  return e;
}

inline Expression& root_of(Expression& a) {
  Expressions& all = Expressions::of_this_thread();
  if (a.kind == ExpressionKind::infinite && a.leaf > 0) return a;
  if (!is_number(a)) return all.make(ExpressionKind::invalid);
  const int sign = sign_of(a);
  if (sign == 0) return a;
  if (sign < 0) return all.make(ExpressionKind::invalid);
  Expression& e = all.make(ExpressionKind::root, &a);
  e.known_sign = 1;
  return e;
}

/// Evaluates e and its operands as intervals of at least `precision` bits.
inline void evaluate(Expression& e, mpfr_prec_t precision) {
  if (e.value.precision() >= precision) return;
  if (e.a != nullptr) evaluate(*e.a, precision);
  if (e.b != nullptr) evaluate(*e.b, precision);
  if (e.kind == ExpressionKind::quotient) {  // b is not zero: at some precision its interval excludes 0
    for (mpfr_prec_t p = precision; e.b->value.sign() == 2;) evaluate(*e.b, p *= 2);
  }
  e.value.set_precision(precision);
  mpfr_t &low = e.value.low, &high = e.value.high;
  switch (e.kind) {
    case ExpressionKind::leaf:
      mpfr_set_d(low, e.leaf, MPFR_RNDD);
      mpfr_set_d(high, e.leaf, MPFR_RNDU);
      break;
    case ExpressionKind::sum:
      mpfr_add(low, e.a->value.low, e.b->value.low, MPFR_RNDD);
      mpfr_add(high, e.a->value.high, e.b->value.high, MPFR_RNDU);
      break;
    case ExpressionKind::difference:
      mpfr_sub(low, e.a->value.low, e.b->value.high, MPFR_RNDD);
      mpfr_sub(high, e.a->value.high, e.b->value.low, MPFR_RNDU);
      break;
    case ExpressionKind::product: multiply(e.value, e.a->value, e.b->value); break;
    case ExpressionKind::quotient: divide(e.value, e.a->value, e.b->value); break;
    case ExpressionKind::root:
      if (mpfr_sgn(e.a->value.low) > 0) {
        mpfr_sqrt(low, e.a->value.low, MPFR_RNDD);
      } else {
        mpfr_set_zero(low, 1);  // the operand is positive; at this precision its interval contains 0
      }
      mpfr_sqrt(high, e.a->value.high, MPFR_RNDU);
      break;
    default: break;
  }
}

/// The exact value of a finite expression.
inline const Constructible& exact_value(Expression& e) {
  if (e.exact) return *e.exact;
  const auto found = [&]() -> Constructible {
    switch (e.kind) {
      case ExpressionKind::sum: return exact_value(*e.a) + exact_value(*e.b);
      case ExpressionKind::difference: return exact_value(*e.a) - exact_value(*e.b);
      case ExpressionKind::product: return exact_value(*e.a) * exact_value(*e.b);
      case ExpressionKind::quotient: return exact_value(*e.a) * inverse(exact_value(*e.b));
      case ExpressionKind::root: return Expressions::of_this_thread().roots().root_of(exact_value(*e.a));
      default: return Constructible(e.leaf);
    }
  };
  return e.exact.emplace(found());
}

/// The sign of a finite expression: -1, 0 or 1.
inline int sign_of(Expression& e) {
  if (e.known_sign != 2) return e.known_sign;
  if (e.kind == ExpressionKind::product || e.kind == ExpressionKind::quotient) {
    return e.known_sign = std::int8_t(sign_of(*e.a) * sign_of(*e.b));
  }
  for (mpfr_prec_t precision = least_precision; precision <= most_precision; precision *= 4) {
    evaluate(e, precision);
    const int sign = e.value.sign();
    if (sign != 2) return e.known_sign = std::int8_t(sign);
  }
  return e.known_sign = std::int8_t(exact_value(e).sign());
}

}  // namespace collide::detail

namespace collide {

/// An exact real number, an infinity, or invalid (like NaN: every comparison is false). `Scalar` is the type of the
/// final answer: its largest finite number limits times. A number lives as long as the evaluation that made it.
template <class Scalar>
class Real {
 public:
  Real() : Real(0.0) {}
  Real(double x) : e_(&detail::leaf_of(x)) {}
  explicit Real(float x) : Real(double(x)) {}
  explicit Real(int x) : Real(double(x)) {}

  friend Real operator-(const Real& a) {
    if (a.e_->kind == detail::ExpressionKind::infinite) return Real(-a.e_->leaf);
    if (a.e_->kind == detail::ExpressionKind::leaf) return Real(-a.e_->leaf);
    return Real(0.0) - a;
  }
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
    using detail::ExpressionKind;
    if (e_->kind == ExpressionKind::infinite || e_->kind == ExpressionKind::leaf) return Scalar(e_->leaf);
    if (e_->kind == ExpressionKind::invalid) return std::numeric_limits<Scalar>::quiet_NaN();
    constexpr int digits = std::numeric_limits<Scalar>::digits;
    constexpr double least = std::numeric_limits<Scalar>::min_exponent - digits - 3;  // log2
    detail::BigInterval memory;
    memory.set_precision(64);
    mpfr_t &middle = memory.low, &width = memory.high;
    double result = 0;
    for (mpfr_prec_t precision = 128;; precision *= 2) {
      detail::evaluate(*e_, precision);
      const auto &low = e_->value.low, &high = e_->value.high;
      mpfr_sub(width, high, low, MPFR_RNDU);
      mpfr_add(middle, low, high, MPFR_RNDN);
      mpfr_div_2ui(middle, middle, 1, MPFR_RNDN);
      const bool narrow = mpfr_zero_p(width) || double(mpfr_get_exp(width)) < least ||
                          (!mpfr_zero_p(middle) && mpfr_get_exp(width) < mpfr_get_exp(middle) - digits - 4);
      if (!narrow) continue;
      result = mpfr_get_d(middle, MPFR_RNDN);
      break;
    }
    return Scalar(result);
  }

 private:
  explicit Real(detail::Expression& e) : e_(&e) {}
  static Real of(detail::ExpressionKind kind, const Real& a, const Real& b) {
    return Real(detail::binary(kind, *a.e_, *b.e_));
  }
  /// -1, 0 or 1 for a < b, a == b, a > b; 2 if one of them is invalid.
  static int order(const Real& a, const Real& b) {
    using detail::ExpressionKind;
    if (a.e_->kind == ExpressionKind::invalid || b.e_->kind == ExpressionKind::invalid) return 2;
    const bool a_infinite = a.e_->kind == ExpressionKind::infinite, b_infinite = b.e_->kind == ExpressionKind::infinite;
    if (a_infinite || b_infinite) {
      const double x = a_infinite ? a.e_->leaf : 0, y = b_infinite ? b.e_->leaf : 0;
      return x < y ? -1 : x > y ? 1 : 0;
    }
    if (a.e_ == b.e_) return 0;
    if (a.e_->kind == ExpressionKind::leaf && b.e_->kind == ExpressionKind::leaf) {
      return a.e_->leaf < b.e_->leaf ? -1 : a.e_->leaf > b.e_->leaf ? 1 : 0;
    }
    if (b.e_->known_sign == 0) return detail::sign_of(*a.e_);
    if (a.e_->known_sign == 0) return -detail::sign_of(*b.e_);
    return detail::sign_of(detail::binary(ExpressionKind::difference, *a.e_, *b.e_));
  }

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
