#include "oracles/outcomes.hpp"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include <bit>
#include <cfenv>

namespace nearmiss::oracle {

namespace {

using Safe = CGAL::Interval_nt<true>;  // sets the rounding mode for each operation itself

Safe enclose(const Rational& q) {
  const auto [low, high] = CGAL::to_interval(q);
  return {low, high};
}

/// The unit in which a member's numbers are compared: one ulp of the largest of them. A normal's is
/// twice that, because the judge rounds it once more when it divides by its length.
double unit_of(const Answer& about, const Layout::Part& part, Scalar scalar) {
  double largest = 0;
  for (std::size_t i = part.begin; i < part.end; ++i) largest = std::max(largest, std::abs(about.values[i]));
  return ulp(largest, scalar) * (part.role == Role::normal ? 2 : 1);
}

}  // namespace

Bounds bounds(const Exact& x) {
  const auto plain = [](const Safe& i) { return Bounds{i.inf(), i.sup()}; };
  if (!x.is_extended() || x.a1() == 0) return plain(enclose(x.a0()));
  const Safe a = enclose(x.a0()), b_root = enclose(x.a1()) * CGAL::sqrt(enclose(x.root()));
  if (CGAL::sign(x.a0()) * CGAL::sign(x.a1()) != CGAL::NEGATIVE) return plain(a + b_root);
  // Opposite signs cancel: divide the exact norm by the conjugate, whose terms add up.
  const Rational norm = x.a0() * x.a0() - x.a1() * x.a1() * x.root();
  return norm == 0 ? Bounds{0, 0} : plain(enclose(norm) / (a - b_root));
}

void Tally::count_everything() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  result_.may_be_yes = result_.may_be_no = result_.may_match = true;
  result_.error.fill({-infinity, infinity});
  result_.mismatched = 0;
  result_.ulps = 0;
  result_.ulps_at_most = infinity;
}

void Tally::count(bool yes, std::span<const Bounds> errors) {
  (yes ? result_.may_be_yes : result_.may_be_no) = true;
  if (yes != about_.yes) return;
  std::uint64_t mismatched = 0;
  double ulps = 0, ulps_at_most = 0;
  int worst = -1;
  for (const Layout::Part& part : layout_.parts) {
    const double unit = unit_of(about_, part, scalar_);
    for (std::size_t i = part.begin; i < part.end && i < errors.size(); ++i) {
      result_.error[i].include(errors[i]);
      if (!about_.gives(i)) continue;
      const double least = errors[i].nearest_to_zero() / unit;
      ulps_at_most = std::max(ulps_at_most, errors[i].furthest_from_zero() / unit);
      if (least > 1) mismatched |= std::uint64_t{1} << i;
      if (least > ulps || worst < 0) ulps = least, worst = int(i);
    }
  }
  if (mismatched == 0) result_.may_match = true;
  const bool better = !any_ || std::popcount(mismatched) < std::popcount(result_.mismatched) ||
                      (std::popcount(mismatched) == std::popcount(result_.mismatched) && ulps < result_.ulps);
  if (better) {
    result_.mismatched = mismatched;
    result_.ulps = ulps;
    result_.ulps_at_most = ulps_at_most;
    result_.worst = worst;
  }
  any_ = true;
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
