/// The two number types of the oracle, and the operations that its algorithms may use.
///
/// Each oracle is written once over a number type N. With N = Interval a comparison may have up to three results, and
/// the algorithm follows each possible branch. With N = Exact a comparison has one result. Only the oracles' .cpp files
/// include this header, because it includes CGAL.
#pragma once

#include "oracles/exact/number_memory.hpp"

/// CGAL takes the memory of a rational number's representation from this allocator.
#define CGAL_ALLOCATOR(T) nearmiss::NumberAllocator<T>

#include <CGAL/Gmpq.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Sqrt_extension.h>

#include <array>
#include <memory>
#include <optional>
#include <stdexcept>
#include <variant>

#include <collide/vec3.hpp>

namespace nearmiss::oracle {

/// Bounds rounded outward. The rounding mode must be upward (CGAL's protector).
using Interval = CGAL::Interval_nt<false>;
using Rational = CGAL::Gmpq;

/// The interval [x, x] of a computed bound, which may be infinite: CGAL's conversion requires a finite number.
inline Interval of_bound(double x) { return {x, x}; }

/// 2^16384, which stands for +infinity among exact numbers. It is beyond every number of a scalar.
inline Rational beyond_all_scalars() {
  Rational x;
  mpz_setbit(mpq_numref(x.mpq()), 16384);
  return x;
}

/// k if the denominator is 2^k, otherwise nothing. Numbers of the input have such denominators, and so have their sums
/// and products.
inline std::optional<mp_bitcnt_t> power_of_denominator(const Rational& x) {
  const mpz_srcptr denominator = mpq_denref(x.mpq());
  const mp_bitcnt_t k = mpz_scan1(denominator, 0);
  return k + 1 == mpz_sizeinbase(denominator, 2) ? std::optional(k) : std::nullopt;
}
/// x / 2^k in lowest terms, in place: a shift instead of a greatest common divisor.
inline void divide_by_power(Rational& x, mp_bitcnt_t k) {
  const mpz_ptr numerator = mpq_numref(x.mpq()), denominator = mpq_denref(x.mpq());
  const mp_bitcnt_t common = mpz_sgn(numerator) == 0 ? k : std::min(k, mpz_scan1(numerator, 0));
  mpz_tdiv_q_2exp(numerator, numerator, common);
  mpz_set_ui(denominator, 1);
  mpz_mul_2exp(denominator, denominator, k - common);
}
inline Rational product(const Rational& x, const Rational& y) {
  const auto i = power_of_denominator(x), k = power_of_denominator(y);
  if (!i || !k) return x * y;
  Rational result;
  mpz_mul(mpq_numref(result.mpq()), mpq_numref(x.mpq()), mpq_numref(y.mpq()));
  divide_by_power(result, *i + *k);
  return result;
}
/// x + y, or x - y where `combine` is mpz_sub.
inline Rational combined(const Rational& x, const Rational& y, void (*combine)(mpz_ptr, mpz_srcptr, mpz_srcptr)) {
  const auto i = power_of_denominator(x), k = power_of_denominator(y);
  if (!i || !k) return combine == mpz_sub ? x - y : x + y;
  Rational result;
  const mpz_ptr numerator = mpq_numref(result.mpq());
  const mp_bitcnt_t largest = std::max(*i, *k);
  if (*i == *k) {
    combine(numerator, mpq_numref(x.mpq()), mpq_numref(y.mpq()));
  } else if (*i < *k) {
    mpz_mul_2exp(numerator, mpq_numref(x.mpq()), *k - *i);
    combine(numerator, numerator, mpq_numref(y.mpq()));
  } else {
    mpz_mul_2exp(numerator, mpq_numref(y.mpq()), *i - *k);
    combine(numerator, mpq_numref(x.mpq()), numerator);
  }
  divide_by_power(result, largest);
  return result;
}

/// a + b sqrt(c) with rational a, b, c. Holds CGAL's Sqrt_extension if there is a root, otherwise a plain rational, as
/// in most operations. Numbers with different roots can be compared, but not added.
class Exact {
 public:
  Exact() = default;
  Exact(int x) : value_(Rational(x)) {}
  explicit Exact(double x) : value_(Rational(x)) {}
  explicit Exact(Rational x) : value_(std::move(x)) {}
  /// a + b sqrt(c), c >= 0.
  Exact(const Rational& a, const Rational& b, const Rational& c) : Exact(Extended(a, b, c)) {}

  bool is_extended() const { return value_.index() == 1; }
  const Rational& a0() const { return is_extended() ? extension()->a0() : rational(); }
  const Rational& a1() const { return extension()->a1(); }  ///< never zero
  const Rational& root() const { return extension()->root(); }

  CGAL::Sign sign() const { return is_extended() ? extension()->sign() : CGAL::sign(rational()); }
  CGAL::Comparison_result compare(const Exact& y) const {
    if (is_extended() || y.is_extended()) return extended().compare(y.extended(), false);
    return CGAL::compare(rational(), y.rational());
  }

  friend Exact operator-(const Exact& x) {
    return x.is_extended() ? Exact(-*x.extension()) : Exact(Rational(-x.rational()));
  }
  friend Exact operator+(const Exact& x, const Exact& y) {
    if (plain(x, y)) return Exact(combined(x.rational(), y.rational(), mpz_add));
    return Exact(x.extended() + y.extended());
  }
  friend Exact operator-(const Exact& x, const Exact& y) {
    if (plain(x, y)) return Exact(combined(x.rational(), y.rational(), mpz_sub));
    return Exact(x.extended() - y.extended());
  }
  friend Exact operator*(const Exact& x, const Exact& y) {
    if (plain(x, y)) return Exact(product(x.rational(), y.rational()));
    return Exact(x.extended() * y.extended());
  }
  friend Exact operator/(const Exact& x, const Exact& y) {
    if (plain(x, y)) return Exact(Rational(x.rational() / y.rational()));
    return Exact(x.extended() / y.extended());
  }

 private:
  using Extended = CGAL::Sqrt_extension<Rational, Rational, CGAL::Tag_true, CGAL::Tag_true>;

  explicit Exact(const Extended& x) {
    if (x.is_extended() && x.a1() != 0) {
      value_ = std::allocate_shared<const Extended>(NumberAllocator<Extended>(), x);
    } else {
      value_ = x.a0();
    }
  }
  const Rational& rational() const { return *std::get_if<0>(&value_); }
  const std::shared_ptr<const Extended>& extension() const { return *std::get_if<1>(&value_); }
  Extended extended() const { return is_extended() ? *extension() : Extended(rational()); }
  /// True if neither number has a root. Throws for two different roots: their sum has no form a + b sqrt(c).
  static bool plain(const Exact& x, const Exact& y) {
    if (x.is_extended() && y.is_extended() && x.root() != y.root()) throw std::logic_error("oracle: two square roots");
    return !x.is_extended() && !y.is_extended();
  }

  std::variant<Rational, std::shared_ptr<const Extended>> value_;
};

// Signs. "May be" is the only question that an algorithm can ask. NaN bounds answer every question with true.

inline bool may_be_negative(const Interval& x) { return !(x.inf() >= 0); }
inline bool may_be_positive(const Interval& x) { return !(x.sup() <= 0); }
inline bool may_be_zero(const Interval& x) { return !(x.inf() > 0) && !(x.sup() < 0); }
inline bool may_be_negative(const Exact& x) { return x.sign() == CGAL::NEGATIVE; }
inline bool may_be_positive(const Exact& x) { return x.sign() == CGAL::POSITIVE; }
inline bool may_be_zero(const Exact& x) { return x.sign() == CGAL::ZERO; }
template <class N>
bool may_be_at_most_zero(const N& x) {
  return may_be_negative(x) || may_be_zero(x);
}
template <class N>
bool may_be_at_least_zero(const N& x) {
  return may_be_positive(x) || may_be_zero(x);
}
template <class N>
bool surely_zero(const N& x) {
  return !may_be_negative(x) && !may_be_positive(x);
}

inline bool may_be_less(const Interval& a, const Interval& b) { return !(a.inf() >= b.sup()); }
inline bool may_be_at_most(const Interval& a, const Interval& b) { return !(a.inf() > b.sup()); }
inline bool may_be_less(const Exact& a, const Exact& b) { return a.compare(b) == CGAL::SMALLER; }
inline bool may_be_at_most(const Exact& a, const Exact& b) { return a.compare(b) != CGAL::LARGER; }

// In a branch that assumes a sign, an interval loses the part that contradicts the assumption.

inline Interval assume_at_least_zero(const Interval& x) { return {std::max(0.0, x.inf()), std::max(0.0, x.sup())}; }
inline Interval assume_at_most_zero(const Interval& x) { return {std::min(0.0, x.inf()), std::min(0.0, x.sup())}; }
inline const Exact& assume_at_least_zero(const Exact& x) { return x; }
inline const Exact& assume_at_most_zero(const Exact& x) { return x; }

/// Loses the part outside [low, high]. The caller knows that the number lies within.
inline Interval assume_within(const Interval& x, double low, double high) {
  return {std::clamp(x.inf(), low, high), std::clamp(x.sup(), low, high)};
}
inline const Exact& assume_within(const Exact& x, double, double) { return x; }

/// True for a number type that encloses many inputs, of which some may lack a root that the others have.
template <class N>
inline constexpr bool is_enclosure = false;
template <>
inline constexpr bool is_enclosure<Interval> = true;

/// Encloses both numbers. For exact numbers returns `a`: an algorithm that joins has not decided.
inline Interval join(const Interval& a, const Interval& b) {
  return {std::min(a.inf(), b.inf()), std::max(a.sup(), b.sup())};
}
inline Exact join(const Exact& a, const Exact&) { return a; }
/// Encloses a number that both enclose.
inline Interval meet(const Interval& a, const Interval& b) {
  const double low = std::max(a.inf(), b.inf()), high = std::min(a.sup(), b.sup());
  return low <= high ? Interval(low, high) : a;
}
inline const Exact& meet(const Exact& a, const Exact&) { return a; }

/// Narrows x to that intersection. False if it is empty, so that the branch is impossible.
inline bool narrow(Interval& x, const Interval& to) {
  const double low = std::max(x.inf(), to.inf()), high = std::min(x.sup(), to.sup());
  if (!(low <= high)) return !(low > high);
  x = Interval(low, high);
  return true;
}
inline bool narrow(Exact&, const Exact&) { return true; }

inline Interval square(const Interval& x) { return CGAL::square(x); }
inline Exact square(const Exact& x) { return x * x; }
inline Interval magnitude(const Interval& x) { return CGAL::abs(x); }
inline Exact magnitude(const Exact& x) { return x.sign() == CGAL::NEGATIVE ? Exact(-x) : x; }

/// The square root of a number that is not negative in the current branch.
inline Interval root(const Interval& x) { return CGAL::sqrt(assume_at_least_zero(x)); }
inline Exact root(const Exact& x) {
  if (x.is_extended()) throw std::logic_error("oracle: a square root of a square root");
  if (x.a0() == 0) return Exact(0);
  return Exact(Rational(0), Rational(1), x.a0());
}

// The oracle's own vectors, so that it shares no arithmetic with the library under test.

template <class N>
using Vector = std::array<N, 3>;

template <class N>
Vector<N> vector(const collide::Vec3<N>& v) {
  return {v.x, v.y, v.z};
}
template <class N>
collide::Vec3<N> answer_vector(const Vector<N>& v) {
  return {v[0], v[1], v[2]};
}
template <class N>
Vector<N> plus(const Vector<N>& a, const Vector<N>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class N>
Vector<N> minus(const Vector<N>& a, const Vector<N>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class N>
Vector<N> times(const Vector<N>& a, const N& s) {
  return {a[0] * s, a[1] * s, a[2] * s};
}
template <class N>
Vector<N> negated(const Vector<N>& a) {
  return {-a[0], -a[1], -a[2]};
}
template <class N>
N dot(const Vector<N>& a, const Vector<N>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class N>
N norm2(const Vector<N>& a) {
  return square(a[0]) + square(a[1]) + square(a[2]);
}
template <class N>
Vector<N> cross(const Vector<N>& a, const Vector<N>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The axes of the rotation q / |q| as rows. Rational in q; each entry lies in [-1, 1].
template <class N, class Q>
std::array<Vector<N>, 3> rotation_axes(const Q& q) {
  const N xx = square(q.x), yy = square(q.y), zz = square(q.z), ww = square(q.w);
  const N scale = N(1) / (xx + yy + zz + ww);
  const auto entry = [&](const N& numerator) { return N(assume_within(numerator * scale, -1.0, 1.0)); };
  const auto twice = [&](const N& sum) { return entry(N(2) * sum); };
  return {{{entry(ww + xx - yy - zz), twice(q.x * q.y + q.w * q.z), twice(q.x * q.z - q.w * q.y)},
           {twice(q.x * q.y - q.w * q.z), entry(ww - xx + yy - zz), twice(q.y * q.z + q.w * q.x)},
           {twice(q.x * q.z + q.w * q.y), twice(q.y * q.z - q.w * q.x), entry(ww - xx - yy + zz)}}};
}
template <class N>
Vector<N> into(const std::array<Vector<N>, 3>& axes, const Vector<N>& world) {
  return {dot(axes[0], world), dot(axes[1], world), dot(axes[2], world)};
}
template <class N>
Vector<N> out_of(const std::array<Vector<N>, 3>& axes, const Vector<N>& local) {
  return plus(plus(times(axes[0], local[0]), times(axes[1], local[1])), times(axes[2], local[2]));
}

}  // namespace nearmiss::oracle
