/// The functions of exact real numbers.
#include "real.hpp"

#include <cmath>
#include <limits>

#include "expression.hpp"

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

void multiply(BigInterval& result, const BigInterval& x, const BigInterval& y) {
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

void divide(BigInterval& result, const BigInterval& x, const BigInterval& y) {
  const bool positive = mpfr_sgn(y.low) > 0;
  const mpfr_t &least = positive ? x.low : x.high, &largest = positive ? x.high : x.low;
  mpfr_div(result.low, least, mpfr_sgn(least) >= 0 ? y.high : y.low, MPFR_RNDD);
  mpfr_div(result.high, largest, mpfr_sgn(largest) >= 0 ? y.low : y.high, MPFR_RNDU);
}

namespace {

bool is_number(const Expression& e) { return e.kind != ExpressionKind::invalid && e.kind != ExpressionKind::infinite; }

/// Evaluates e and its operands as intervals of at least `precision` bits.
void evaluate(Expression& e, mpfr_prec_t precision) {
  if (e.value.precision() >= precision) return;
  if (e.a != nullptr) evaluate(*e.a, precision);
  if (e.b != nullptr) evaluate(*e.b, precision);
  if (e.kind == ExpressionKind::quotient) {  // b is not zero: at some precision its interval excludes 0
    // A quotient has two operands. NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage)
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
const Constructible& exact_value(Expression& e) {
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
int sign_of(Expression& e) {
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

/// The number as a double, if it is a leaf, infinite or invalid.
std::optional<double> simple_value(const Expression& e) {
  if (e.kind == ExpressionKind::infinite || e.kind == ExpressionKind::leaf) return e.leaf;
  if (e.kind == ExpressionKind::invalid) return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

}  // namespace

void clear_expressions() { Expressions::of_this_thread().clear(); }

Expression& leaf_of(double x) {
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

Expression& negative_of(Expression& a) {
  if (a.kind == ExpressionKind::infinite || a.kind == ExpressionKind::leaf) return leaf_of(-a.leaf);
  return binary(ExpressionKind::difference, leaf_of(0), a);
}

Expression& binary(ExpressionKind kind, Expression& a, Expression& b) {
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

Expression& root_of(Expression& a) {
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

int order(Expression& a, Expression& b) {
  if (a.kind == ExpressionKind::invalid || b.kind == ExpressionKind::invalid) return 2;
  const bool a_infinite = a.kind == ExpressionKind::infinite, b_infinite = b.kind == ExpressionKind::infinite;
  if (a_infinite || b_infinite) {
    const double x = a_infinite ? a.leaf : 0, y = b_infinite ? b.leaf : 0;
    return x < y ? -1 : x > y ? 1 : 0;
  }
  if (&a == &b) return 0;
  if (a.kind == ExpressionKind::leaf && b.kind == ExpressionKind::leaf) {
    return a.leaf < b.leaf ? -1 : a.leaf > b.leaf ? 1 : 0;
  }
  if (b.known_sign == 0) return sign_of(a);
  if (a.known_sign == 0) return -sign_of(b);
  return sign_of(binary(ExpressionKind::difference, a, b));
}

double rounded(Expression& e, int digits, double least) {
  if (const std::optional<double> simple = simple_value(e)) return *simple;
  BigInterval memory;
  memory.set_precision(64);
  mpfr_t &middle = memory.low, &width = memory.high;
  for (mpfr_prec_t precision = 128;; precision *= 2) {
    evaluate(e, precision);
    const auto &low = e.value.low, &high = e.value.high;
    mpfr_sub(width, high, low, MPFR_RNDU);
    mpfr_add(middle, low, high, MPFR_RNDN);
    mpfr_div_2ui(middle, middle, 1, MPFR_RNDN);
    const bool narrow = mpfr_zero_p(width) || double(mpfr_get_exp(width)) < least ||
                        (!mpfr_zero_p(middle) && mpfr_get_exp(width) < mpfr_get_exp(middle) - digits - 4);
    if (narrow) return mpfr_get_d(middle, MPFR_RNDN);
  }
}

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
