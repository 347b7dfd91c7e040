#include "oracles/outcomes.hpp"

#include <mpfr.h>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include <bit>
#include <cfenv>

namespace nearmiss::oracle {

namespace {

/// A number of 256 bits; every operation below rounds to nearest, with a relative error of 2^-256.
class Wide {
 public:
  Wide() { mpfr_init2(value_, 256); }
  explicit Wide(const Rational& q) : Wide() { mpfr_set_q(value_, q.mpq(), MPFR_RNDN); }
  ~Wide() { mpfr_clear(value_); }
  Wide(const Wide&) = delete;
  Wide& operator=(const Wide&) = delete;

  mpfr_t& get() { return value_; }
  const mpfr_t& get() const { return value_; }
  /// Doubles around the number, which at most ten operations on numbers up to `largest` made of exact ones.
  Bounds around(const Wide& largest) const {
    Wide slack;
    mpfr_div_2ui(slack.value_, largest.value_, 250, MPFR_RNDU);
    mpfr_abs(slack.value_, slack.value_, MPFR_RNDU);
    Wide end;
    mpfr_sub(end.value_, value_, slack.value_, MPFR_RNDD);
    const double low = mpfr_get_d(end.value_, MPFR_RNDD);
    mpfr_add(end.value_, value_, slack.value_, MPFR_RNDU);
    return {low, mpfr_get_d(end.value_, MPFR_RNDU)};
  }
  bool is_at_least(const Wide& x, unsigned long over_two_to) const {
    return mpfr_zero_p(value_) == 0 && mpfr_get_exp(value_) + mpfr_exp_t(over_two_to) > mpfr_get_exp(x.value_);
  }

 private:
  mpfr_t value_;
};

/// The unit in which a member's numbers are compared: one ulp of the largest of them, given or exact. A
/// normal's is twice that, because the judge rounds it once more when it divides by its length.
double unit_of(const Answer& about, const Layout::Part& part, std::span<const Bounds> errors, Scalar scalar) {
  double largest = 0;
  for (std::size_t i = part.begin; i < part.end && i < errors.size(); ++i) {
    largest = std::max(largest, std::abs(about.values[i]));
    largest = std::max({largest, about.values[i] + errors[i].high, -(about.values[i] + errors[i].low)});
  }
  return ulp(std::min(largest, largest_finite(scalar)), scalar) * (part.role == Role::normal ? 2 : 1);
}

}  // namespace

Bounds bounds(const Exact& x) {
  if (!x.is_extended()) {
    const auto [low, high] = CGAL::to_interval(x.a0());
    return {low, high};
  }
  Wide a(x.a0()), b(x.a1()), value(x.root()), sum;
  mpfr_sqrt(value.get(), value.get(), MPFR_RNDN);
  mpfr_mul(value.get(), value.get(), b.get(), MPFR_RNDN);
  mpfr_add(sum.get(), a.get(), value.get(), MPFR_RNDN);
  if (CGAL::sign(x.a0()) * CGAL::sign(x.a1()) != CGAL::NEGATIVE) return sum.around(sum);
  constexpr unsigned long bits_to_lose = 100;  // of 250
  if (sum.is_at_least(a, bits_to_lose)) {
    const Wide& larger = mpfr_cmpabs(a.get(), value.get()) > 0 ? a : value;
    return sum.around(larger);
  }
  // What nearly cancels: divide the exact norm by the conjugate, whose terms add up.
  Wide norm(Rational(x.a0() * x.a0() - x.a1() * x.a1() * x.root()));
  mpfr_sub(value.get(), a.get(), value.get(), MPFR_RNDN);
  mpfr_div(value.get(), norm.get(), value.get(), MPFR_RNDN);
  return value.around(value);
}

void Tally::count_everything() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  result_.may_be_yes = result_.may_be_no = result_.may_match = true;
  result_.error.fill({-infinity, infinity});
  result_.mismatched = 0;
  result_.ulps = result_.absolute = 0;
  result_.ulps_at_most = result_.ulps_at_most_of_any = infinity;
}

void Tally::count(bool yes, std::span<const Bounds> errors, const std::optional<Bounds>& turn) {
  (yes ? result_.may_be_yes : result_.may_be_no) = true;
  if (yes != about_.yes) return;
  std::uint64_t mismatched = 0;
  double ulps = 0, ulps_at_most = 0, absolute = 0;
  int worst = -1;
  for (const Layout::Part& part : layout_.parts) {
    const double unit = unit_of(about_, part, errors, scalar_);
    for (std::size_t i = part.begin; i < part.end && i < errors.size(); ++i) {
      result_.error[i].include(errors[i]);
      if (!about_.gives(i)) continue;
      const Bounds& off = part.role == Role::normal && turn ? *turn : errors[i];
      const double least = off.nearest_to_zero() / unit;
      ulps_at_most = std::max(ulps_at_most, off.furthest_from_zero() / unit);
      if (least > 1) mismatched |= std::uint64_t{1} << i;
      if (least > ulps || worst < 0) ulps = least, absolute = off.nearest_to_zero(), worst = int(i);
    }
  }
  if (mismatched == 0) result_.may_match = true;
  result_.ulps_at_most_of_any = std::max(result_.ulps_at_most_of_any, ulps_at_most);
  const bool better = !any_ || std::popcount(mismatched) < std::popcount(result_.mismatched) ||
                      (std::popcount(mismatched) == std::popcount(result_.mismatched) && ulps < result_.ulps);
  if (better) {
    result_.mismatched = mismatched;
    result_.ulps = ulps;
    result_.absolute = absolute;
    result_.ulps_at_most = ulps_at_most;
    result_.worst = worst;
  }
  any_ = true;
}

std::optional<PlaceInAnswer> PlaceInAnswer::of(const Answer& about, const Layout& layout, std::size_t number,
                                               double ulps, Scalar scalar) {
  const auto part = std::find_if(layout.parts.begin(), layout.parts.end(),
                                 [&](const Layout::Part& p) { return p.begin <= number && number < p.end; });
  if (part == layout.parts.end() || part->role != Role::position || part->end - part->begin != 3) return std::nullopt;
  double largest = 0;
  for (std::size_t i = part->begin; i < part->end; ++i) {
    if (!about.gives(i) || !std::isfinite(about.values[i])) return std::nullopt;
    largest = std::max(largest, std::abs(about.values[i]));
  }
  // One ulp is that of the largest number, given or exact, and the exact one may be larger by the slack itself.
  const double share = 4 * ulps * unit_roundoff(scalar);
  if (!(share <= 0.5)) return std::nullopt;
  const double unit = ulp(std::min(largest * (1 + share), largest_finite(scalar)), scalar);
  const double slack = ulps * unit * 1.7320508075688774;  // rounded up from the root of 3
  if (!std::isfinite(slack)) return std::nullopt;
  return PlaceInAnswer{part->begin, std::nextafter(slack, HUGE_VAL)};
}

#if defined(__SSE2__)
namespace {
constexpr unsigned invalid_flag = 0x01;
}
IntervalScope::IntervalScope() { _mm_setcsr(_mm_getcsr() & ~invalid_flag); }
bool IntervalScope::any_invalid() const { return (_mm_getcsr() & invalid_flag) != 0; }
#else
IntervalScope::IntervalScope() { std::feclearexcept(FE_INVALID); }
bool IntervalScope::any_invalid() const { return std::fetestexcept(FE_INVALID) != 0; }
#endif

}  // namespace nearmiss::oracle
