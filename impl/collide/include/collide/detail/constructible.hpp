/// Exact constructible numbers: rationals combined by + - * / and square roots. Their signs are found by rational
/// arithmetic alone. Needs GMP (target collide::certified).
#pragma once

#include <gmpxx.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <collide/detail/strict_begin.hpp>

namespace collide::detail {

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
  explicit Constructible(mpq_class x) : rational_(std::move(x)) {}

  friend Constructible operator+(const Constructible& x, const Constructible& y) {
    if (x.height() < y.height()) return y + x;
    if (x.is_rational()) return Constructible(mpq_class(x.rational_ + y.rational_));
    if (x.height() > y.height()) return make_extension(x.root(), x.a() + y, x.b());
    return make_extension(x.root(), x.a() + y.a(), x.b() + y.b());
  }
  friend Constructible operator*(const Constructible& x, const Constructible& y) {
    if (x.height() < y.height()) return y * x;
    if (x.is_rational()) return Constructible(mpq_class(x.rational_ * y.rational_));
    if (x.height() > y.height()) return make_extension(x.root(), x.a() * y, x.b() * y);
    return make_extension(x.root(), x.a() * y.a() + x.b() * y.b() * x.d(), x.a() * y.b() + x.b() * y.a());
  }
  friend Constructible operator-(const Constructible& x) {
    if (x.is_rational()) return Constructible(mpq_class(-x.rational_));
    return make_extension(x.root(), -x.a(), -x.b());
  }
  friend Constructible operator-(const Constructible& x, const Constructible& y) { return x + -y; }
  /// 1 / x; x is not zero.
  friend Constructible inverse(const Constructible& x) {
    if (x.is_rational()) return Constructible(mpq_class(1 / x.rational_));
    const Constructible norm = x.norm();
    if (norm.sign() == 0) return inverse(x.a() + x.a());
    return make_extension(x.root(), x.a(), -x.b()) * inverse(norm);
  }

  /// -1, 0 or 1.
  int sign() const {
    if (is_rational()) return sgn(rational_);
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

  mpq_class rational_;  // the value if there is no extension
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
  if (b.is_rational() && b.rational_ == 0) return a;
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
      if (const auto root = rational_root_of(square.rational_)) return Constructible(*root);
      for (const auto& earlier : roots_) {
        if (!earlier->square.is_rational()) continue;
        if (const auto times = rational_root_of(mpq_class(square.rational_ / earlier->square.rational_))) {
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
  static std::optional<mpq_class> rational_root_of(const mpq_class& square) {
    const mpz_class &over = square.get_num(), &under = square.get_den();
    if (!mpz_perfect_square_p(over.get_mpz_t()) || !mpz_perfect_square_p(under.get_mpz_t())) return std::nullopt;
    return mpq_class(mpz_class(sqrt(over)), mpz_class(sqrt(under)));
  }

  std::vector<std::shared_ptr<const Constructible::Root>> roots_;
};

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
