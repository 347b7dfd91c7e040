/// Exact numbers as floating-point numbers of many bits. Only the oracles' .cpp files include it.
#pragma once

#include <cstdio>  // before mpfr.h, which then declares mpfr_asprintf

#include <mpfr.h>

#include "oracles/exact/arithmetic.hpp"

namespace nearmiss::oracle {

/// A floating-point number of a given precision.
class Wide {
 public:
  explicit Wide(mpfr_prec_t bits) { mpfr_init2(value_, bits); }
  ~Wide() { mpfr_clear(value_); }
  Wide(const Wide&) = delete;
  Wide& operator=(const Wide&) = delete;

  mpfr_t& get() { return value_; }
  const mpfr_t& get() const { return value_; }

 private:
  mpfr_t value_;
};

/// Encloses x. Both bounds have the same precision of p bits, more than `bits_lost`; they differ by at most
/// 2^(bits_lost - p) times the magnitude of x.
inline constexpr mpfr_prec_t bits_lost = 110;
void enclose(const Exact& x, Wide& low, Wide& high);

}  // namespace nearmiss::oracle
