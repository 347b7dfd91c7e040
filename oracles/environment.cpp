/// The one place that asserts IEEE 754 arithmetic. Three compiler settings would silently break it:
/// - fast-math lets the compiler reassociate: sums lose the order on which error bounds rest, NaN tests vanish, and
///   interval bounds no longer enclose;
/// - contraction (-ffp-contract) turns a * b + c into one rounding at the compiler's choice: the same source gives
///   other results under another compiler, and a * b - b * a need not be zero;
/// - excess precision (FLT_EVAL_METHOD) rounds twice.
#include "oracles/environment.hpp"

#include <cfenv>
#include <cfloat>
#include <limits>

#include "impl/subject/floating_point.hpp"
#include "oracles/exact/answer_sink.hpp"
#include "oracles/exact/arithmetic.hpp"

#if defined(__FAST_MATH__) || defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "Nearmiss needs IEEE 754 arithmetic: compile without -ffast-math"
#endif

namespace nearmiss {

namespace {

static_assert(std::numeric_limits<float>::is_iec559 && std::numeric_limits<double>::is_iec559);
static_assert(FLT_EVAL_METHOD == 0, "floats must be computed as floats and doubles as doubles");

/// Hides the value of its argument from the optimizer.
[[gnu::noinline]] double opaque(double x) {
  asm volatile("" : "+m"(x));
  return x;
}

/// A product minus its own rounded value is 0, unless the compiler contracts the two operations into one.
bool contracts() {
  const double a = opaque(1 + 0x1p-27);
  const double rounded = opaque(a * a);
  return a * a - rounded != 0;
}

bool rounds_subnormals_away() { return opaque(0x1p-1074) * opaque(1.0) == 0; }

/// The intervals of 1/3, 1 - 2^-60 and sqrt(2) strictly contain these numbers, and a product with a negative factor has
/// its bounds in ascending order.
bool intervals_hold() {
  const oracle::IntervalScope scope;
  oracle::arithmetic_barrier();
  const oracle::Interval third = oracle::Interval(opaque(1)) / oracle::Interval(opaque(3));
  const oracle::Interval near_one = oracle::Interval(opaque(1)) - oracle::Interval(opaque(0x1p-60));
  const oracle::Interval root = oracle::root(oracle::Interval(opaque(2)));
  const oracle::Interval product = third * oracle::Interval(opaque(-3));
  oracle::arithmetic_barrier();
  const auto strict = [](const oracle::Interval& x) { return x.inf() < x.sup() && x.sup() - x.inf() < 1e-15; };
  return strict(third) && strict(near_one) && near_one.sup() == 1 && strict(root) && product.inf() < -1 &&
         product.sup() > -1 && !scope.any_invalid();
}

bool invalid_is_noticed() {
  const oracle::IntervalScope scope;
  oracle::arithmetic_barrier();
  const double infinity = opaque(std::numeric_limits<double>::infinity());
  [[maybe_unused]] volatile double nothing = infinity - infinity;
  oracle::arithmetic_barrier();
  return scope.any_invalid();
}

}  // namespace

std::optional<std::string> broken_environment() {
  const FloatingPointScope standard_modes;
  if (contracts()) return "floating point: products and sums are contracted; compile with -ffp-contract=off";
  if (rounds_subnormals_away()) return "floating point: subnormal numbers are flushed to zero";
  if (!intervals_hold()) return "floating point: directed rounding does not work, so intervals are no bounds";
  if (!invalid_is_noticed()) return "floating point: invalid operations raise no flag";
  return std::nullopt;
}

}  // namespace nearmiss
