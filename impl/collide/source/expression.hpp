/// The nodes of exact real numbers (real.hpp), their intervals and their signs. Needs MPFR and GMP.
#pragma once

#include <mpfr.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "constructible.hpp"
#include "real.hpp"

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
void multiply(BigInterval& result, const BigInterval& x, const BigInterval& y);
/// result = x / y, rounded outward; y does not contain 0, and `result` is neither x nor y.
void divide(BigInterval& result, const BigInterval& x, const BigInterval& y);

/// A node of an expression. Its sign is found by interval evaluation in increasing precision; if the interval still
/// contains zero at the highest one, the value is computed exactly, in a tower of square roots (constructible.hpp).
struct Expression {
  using Kind = ExpressionKind;

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

}  // namespace collide::detail

#include <collide/detail/strict_end.hpp>
