#include "oracles/exact/decimal.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string_view>

#include "oracles/exact/answer_sink.hpp"
#include "oracles/exact/wide.hpp"

namespace nearmiss::oracle {

namespace {

double next(double x, Scalar scalar) {
  if (scalar == Scalar::float64) return std::nextafter(x, HUGE_VAL);
  return double(std::nextafter(float(x), HUGE_VALF));
}
double previous(double x, Scalar scalar) { return -next(-x, scalar); }

/// The largest number of the scalar, or -infinity, that is at most x.
double at_most(double x, Scalar scalar) {
  const double near = scalar == Scalar::float32 ? double(float(x)) : x;
  return near > x ? previous(near, scalar) : near;
}

/// The number; in place of an infinity the power of two that follows the largest one.
Rational as_rational(double x, Scalar scalar) {
  if (std::isfinite(x)) return Rational(x);
  const Rational largest(largest_finite(scalar)), beyond = largest + Rational(ulp(largest_finite(scalar), scalar));
  return x > 0 ? beyond : Rational(-beyond);
}

bool is_even(double x, Scalar scalar) {
  if (!std::isfinite(x)) return true;
  return std::fmod(x / ulp(x, scalar), 2) == 0;
}

std::string shortest(double x, Scalar scalar) {
  const double without_sign_of_zero = x + 0.0;
  return scalar == Scalar::float32 ? fmt::format("{}", float(without_sign_of_zero))
                                   : fmt::format("{}", without_sign_of_zero);
}

/// "-1.25e-07" as a rational number.
Rational rational_of(std::string_view decimal) {
  const std::size_t e = std::min(decimal.find('e'), decimal.size());
  int exponent = e < decimal.size() ? std::atoi(decimal.substr(e + 1).data()) : 0;
  std::string digits(decimal.substr(0, e));
  if (const std::size_t point = digits.find('.'); point != std::string::npos) {
    exponent -= int(digits.size() - point - 1);
    digits.erase(point, 1);
  }
  CGAL::Gmpz power;
  mpz_ui_pow_ui(power.mpz(), 10, static_cast<unsigned long>(std::abs(exponent)));
  const Rational whole{CGAL::Gmpz(digits)};
  return exponent < 0 ? Rational(whole / Rational(power)) : Rational(whole * Rational(power));
}

bool equals(const Exact& x, const Rational& y) { return x.compare(Exact(y)) == CGAL::EQUAL; }

/// The nearest decimal of so many digits in the layout of "%g"; zeros at the end are left out where `shorten` is set.
std::string rounded_text(const Wide& x, int digits, bool shorten) {
  char* text = nullptr;
  if (mpfr_asprintf(&text, shorten ? "%.*RNg" : "%#.*RNg", digits, x.get()) < 0) throw std::bad_alloc();
  std::string copy = text;
  mpfr_free_str(text);
  if (copy.ends_with('.')) copy.pop_back();
  return copy;
}

/// Of a decimal that rounded_text() made.
bool has_even_last_digit(std::string_view decimal) {
  const std::string_view digits = decimal.substr(0, decimal.find('e'));
  return (digits.back() - '0') % 2 == 0;
}

}  // namespace

double nearest_number(const Exact& x, Scalar scalar) {
  const Bounds b = bounds(x);
  double low = at_most(std::min(b.low, std::numeric_limits<double>::max()), scalar);
  for (double high = next(low, scalar);; low = high, high = next(low, scalar)) {
    const Rational middle = (as_rational(low, scalar) + as_rational(high, scalar)) / Rational(2);
    const CGAL::Comparison_result side = x.compare(Exact(middle));
    if (side == CGAL::SMALLER) return low;
    if (side == CGAL::EQUAL) return is_even(low, scalar) ? low : high;
    if (std::isinf(high)) return high;
  }
}

std::string decimal_of(const Exact& x, double nearest, Scalar scalar) {
  if (equals(x, beyond_all_scalars())) return "inf";
  if (std::isfinite(nearest) && equals(x, Rational(nearest))) return shortest(nearest, scalar);
  const double as_double = scalar == Scalar::float64 ? nearest : nearest_number(x, Scalar::float64);
  if (std::isinf(as_double)) return as_double > 0 ? "> 1.7976931348623157e+308" : "< -1.7976931348623157e+308";
  std::string text = shortest(as_double, Scalar::float64);
  if (scalar == Scalar::float32 && double(std::strtof(text.c_str(), nullptr)) != nearest)
    text = shortest(nearest, scalar);
  return equals(x, rational_of(text)) ? text : "≈" + text;
}

std::string decimal_of_digits(const Exact& x, int digits) {
  if (equals(x, beyond_all_scalars())) return "inf";
  if (equals(x, Rational(0))) return "0";
  constexpr double bits_of_a_digit = 3.33;  // above log2(10)
  constexpr mpfr_prec_t bits_to_spare = 16;
  const auto bits = mpfr_prec_t(std::ceil(bits_of_a_digit * digits)) + bits_lost + bits_to_spare;
  Wide low(bits), high(bits);
  enclose(x, low, high);
  // The bounds are so near to each other that at most one border between two decimals lies within them.
  const std::string below = rounded_text(low, digits, false), above = rounded_text(high, digits, false);
  bool is_below = below == above;
  if (!is_below) {
    const Rational border = (rational_of(below) + rational_of(above)) / Rational(2);
    const CGAL::Comparison_result side = x.compare(Exact(border));
    is_below = side == CGAL::SMALLER || (side == CGAL::EQUAL && has_even_last_digit(below));
  }
  const std::string& nearest = is_below ? below : above;
  return equals(x, rational_of(nearest)) ? rounded_text(is_below ? low : high, digits, true) : "≈" + nearest;
}

}  // namespace nearmiss::oracle
