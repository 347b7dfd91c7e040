#include "oracles/exact/wide.hpp"

namespace nearmiss::oracle {

namespace {

/// Every operation here rounds to nearest, with a relative error of at most 2^-p.
void set(Wide& to, const Rational& q) { mpfr_set_q(to.get(), q.mpq(), MPFR_RNDN); }

/// Encloses the exact value of `about`, if at most ten operations on numbers up to `largest` made it.
void enclose_around(const Wide& about, const Wide& largest, Wide& low, Wide& high) {
  const mpfr_prec_t bits = mpfr_get_prec(about.get());
  constexpr mpfr_prec_t bits_of_ten_operations = 6;
  Wide slack(bits);
  mpfr_div_2ui(slack.get(), largest.get(), static_cast<unsigned long>(bits - bits_of_ten_operations), MPFR_RNDU);
  mpfr_abs(slack.get(), slack.get(), MPFR_RNDU);
  mpfr_sub(low.get(), about.get(), slack.get(), MPFR_RNDD);
  mpfr_add(high.get(), about.get(), slack.get(), MPFR_RNDU);
}

bool is_at_least(const Wide& sum, const Wide& part, mpfr_exp_t over_two_to) {
  return mpfr_zero_p(sum.get()) == 0 && mpfr_get_exp(sum.get()) + over_two_to > mpfr_get_exp(part.get());
}

}  // namespace

void enclose(const Exact& x, Wide& low, Wide& high) {
  const mpfr_prec_t bits = mpfr_get_prec(low.get());
  if (!x.is_extended()) {
    mpfr_set_q(low.get(), x.a0().mpq(), MPFR_RNDD);
    mpfr_set_q(high.get(), x.a0().mpq(), MPFR_RNDU);
    return;
  }
  Wide a(bits), b(bits), value(bits), sum(bits);
  set(a, x.a0()), set(b, x.a1()), set(value, x.root());
  mpfr_sqrt(value.get(), value.get(), MPFR_RNDN);
  mpfr_mul(value.get(), value.get(), b.get(), MPFR_RNDN);
  mpfr_add(sum.get(), a.get(), value.get(), MPFR_RNDN);
  if (CGAL::sign(x.a0()) * CGAL::sign(x.a1()) != CGAL::NEGATIVE) return enclose_around(sum, sum, low, high);
  constexpr mpfr_exp_t bits_to_lose = 100;
  if (is_at_least(sum, a, bits_to_lose))
    return enclose_around(sum, mpfr_cmpabs(a.get(), value.get()) > 0 ? a : value, low, high);
  // Cancellation: divide the exact norm a^2 - b^2 c by the conjugate, whose terms have the same sign.
  Wide norm(bits);
  set(norm, Rational(x.a0() * x.a0() - x.a1() * x.a1() * x.root()));
  mpfr_sub(value.get(), a.get(), value.get(), MPFR_RNDN);
  mpfr_div(value.get(), norm.get(), value.get(), MPFR_RNDN);
  enclose_around(value, value, low, high);
}

}  // namespace nearmiss::oracle
