/// Exact constructible numbers: rationals combined by + - * / and square roots. Their signs are found by rational
/// arithmetic alone. Needs GMP (target collide::certified).
#pragma once

#include <gmp.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

/// A rational number. It is GMP's, without gmpxx.h, which needs exceptions.
class Rational {
 public:
  Rational() { mpq_init(q_); }
  explicit Rational(double x) : Rational() { mpq_set_d(q_, x); }
  Rational(const Rational& x) : Rational() { mpq_set(q_, x.q_); }
  Rational(Rational&& x) noexcept : Rational() { mpq_swap(q_, x.q_); }
  Rational& operator=(Rational x) noexcept {
    mpq_swap(q_, x.q_);
    return *this;
  }
  ~Rational() { mpq_clear(q_); }

  friend Rational operator-(const Rational& x) { return of(mpq_neg, x); }
  friend Rational operator+(const Rational& x, const Rational& y) { return of(mpq_add, x, y); }
  friend Rational operator*(const Rational& x, const Rational& y) { return of(mpq_mul, x, y); }
  /// x / y; y is not zero.
  friend Rational operator/(const Rational& x, const Rational& y) { return of(mpq_div, x, y); }
  /// 1 / x; x is not zero.
  friend Rational inverse(const Rational& x) { return of(mpq_inv, x); }

  /// -1, 0 or 1.
  int sign() const { return mpq_sgn(q_); }
  /// The root, if it is rational; the number is not negative.
  std::optional<Rational> rational_root() const {
    const mpz_srcptr over = mpq_numref(q_), under = mpq_denref(q_);
    if (mpz_perfect_square_p(over) == 0 || mpz_perfect_square_p(under) == 0) return std::nullopt;
    Rational root;
    mpz_sqrt(mpq_numref(root.q_), over);
    mpz_sqrt(mpq_denref(root.q_), under);
    return root;
  }

 private:
  template <class Operation, class... Operands>
  static Rational of(Operation operation, const Operands&... operands) {
    Rational result;
    operation(result.q_, operands.q_...);
    return result;
  }

  mpq_t q_;
};

/// A rational, or a + b sqrt(d), where a, b and d are rationals or contain roots that were taken before sqrt(d).
///
/// The numbers form a tower of quadratic extensions of the rationals. A root sqrt(d) may already lie in the tower below
/// it; this is not checked. A number then has several representations, and the following holds for each of them.
///
/// 1. a + b sqrt(d), where a and b have opposite signs, has the sign of a times that of a^2 - b^2 d
/// 2. 1 / (a + b sqrt(d)) == (a - b sqrt(d)) / (a^2 - b^2 d), or 1 / (2 a) where that divisor is zero
///
/// The sign of a number with n roots needs signs of numbers with n - 1 roots and twice as many bits. The work is
/// therefore bounded by the bits of the input and the number of different roots, of which each query has only a few.
class Constructible {
 public:
  Constructible() = default;
  explicit Constructible(double x) : rational_(x) {}
  explicit Constructible(Rational x) : rational_(std::move(x)) {}

  friend Constructible operator+(const Constructible& x, const Constructible& y) {
    if (x.height() < y.height()) return y + x;
    if (x.is_rational()) return Constructible(x.rational_ + y.rational_);
    if (x.height() > y.height()) return make_extension(x.root(), x.a() + y, x.b());
    return make_extension(x.root(), x.a() + y.a(), x.b() + y.b());
  }
  friend Constructible operator*(const Constructible& x, const Constructible& y) {
    if (x.height() < y.height()) return y * x;
    if (x.is_rational()) return Constructible(x.rational_ * y.rational_);
    if (x.height() > y.height()) return make_extension(x.root(), x.a() * y, x.b() * y);
    return make_extension(x.root(), x.a() * y.a() + x.b() * y.b() * x.d(), x.a() * y.b() + x.b() * y.a());
  }
  friend Constructible operator-(const Constructible& x) {
    if (x.is_rational()) return Constructible(-x.rational_);
    return make_extension(x.root(), -x.a(), -x.b());
  }
  friend Constructible operator-(const Constructible& x, const Constructible& y) { return x + -y; }
  /// 1 / x; x is not zero.
  friend Constructible inverse(const Constructible& x) {
    if (x.is_rational()) return Constructible(inverse(x.rational_));
    const Constructible norm = x.norm();
    if (norm.sign() == 0) return inverse(x.a() + x.a());
    return make_extension(x.root(), x.a(), -x.b()) * inverse(norm);
  }

  /// -1, 0 or 1.
  int sign() const {
    if (is_rational()) return rational_.sign();
    const int of_a = a().sign(), of_b = b().sign();
    if (of_b == 0 || of_a == of_b) return of_a;
    return of_a == 0 ? of_b : of_a * norm().sign();
  }

 private:
  friend class Roots;
  struct Root;
  struct Extension;

  /// a + b sqrt(d)
  static inline Constructible make_extension(const std::shared_ptr<const Root>& root, Constructible a, Constructible b);
  bool is_rational() const { return extension_ == nullptr; }
  inline std::uint32_t height() const;
  inline const std::shared_ptr<const Root>& root() const;
  inline const Constructible& a() const;
  inline const Constructible& b() const;
  inline const Constructible& d() const;
  /// a^2 - b^2 d
  Constructible norm() const { return a() * a() - b() * b() * d(); }

  Rational rational_;  // the value if there is no extension
  std::shared_ptr<const Extension> extension_;
};

struct Constructible::Root {
  std::uint32_t height;  // counted from 1; roots lower in the tower have smaller ones
  Constructible square;
};
struct Constructible::Extension {
  std::shared_ptr<const Root> root;
  Constructible a, b;
};

inline Constructible Constructible::make_extension(const std::shared_ptr<const Root>& root, Constructible a,
                                                   Constructible b) {
  if (b.is_rational() && b.rational_.sign() == 0) return a;
  Constructible x;
  x.extension_ = std::make_shared<const Extension>(Extension{root, std::move(a), std::move(b)});
  return x;
}
inline std::uint32_t Constructible::height() const { return is_rational() ? 0 : root()->height; }
inline const std::shared_ptr<const Constructible::Root>& Constructible::root() const { return extension_->root; }
inline const Constructible& Constructible::a() const { return extension_->a; }
inline const Constructible& Constructible::b() const { return extension_->b; }
inline const Constructible& Constructible::d() const { return extension_->root->square; }

/// The square roots taken in one evaluation.
class Roots {
 public:
  /// The square root of a positive number. If the ratio of a rational number to an earlier rational square is itself a
  /// square, the result is a rational multiple of the earlier root.
  Constructible root_of(const Constructible& square) {
    if (square.is_rational()) {
      if (const auto root = square.rational_.rational_root()) return Constructible(*root);
      for (const auto& earlier : roots_) {
        if (!earlier->square.is_rational()) continue;
        if (const auto times = (square.rational_ / earlier->square.rational_).rational_root()) {
          return Constructible::make_extension(earlier, {}, Constructible(*times));
        }
      }
    }
    roots_.push_back(
        std::make_shared<const Constructible::Root>(Constructible::Root{std::uint32_t(roots_.size() + 1), square}));
    return Constructible::make_extension(roots_.back(), {}, Constructible(1.0));
  }
  void clear() { roots_.clear(); }

 private:
  std::vector<std::shared_ptr<const Constructible::Root>> roots_;
};

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
