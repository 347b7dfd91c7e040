/// The number types below the tiers keep their error bounds, compared with rationals and 512-bit numbers.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "impl/collide/source/expression.hpp"
#include "impl/collide/source/stages.hpp"

namespace collide {
namespace {

using Q = mpq_class;
using Wide = DoubleWord<double>;

Q exact(double x) { return Q(x); }
Q exact(const Wide& x) { return Q(x.high) + Q(x.low); }

/// Doubles with few bits (ties, exact results, zeros) and with many, of moderate exponents.
double draw(std::mt19937_64& random) {
  const double sign = random() % 2 == 0 ? 1 : -1;
  if (random() % 4 == 0) return sign * double(random() % 8);
  return sign * std::ldexp(double(random() >> 11), int(random() % 40) - 73);
}
Wide draw_wide(std::mt19937_64& random) {
  return Wide::two_sum(draw(random), random() % 3 == 0 ? 0.0 : draw(random) * 0x1p-53);
}

/// A number with an error of at most `error`, and the exact number.
template <class N>
struct Known {
  N number;
  Q truth;
};
Known<Bounded<double>> draw_known(std::mt19937_64& random, Bounded<double>*) {
  const double x = draw(random), error = random() % 3 == 0 ? 0 : std::abs(draw(random)) * 0x1p-40;
  const Q share(double(random() % 2001) / 1000 - 1);
  return {{x, error}, Q(x) + share * Q(error)};
}
Known<WideBounded<double>> draw_known(std::mt19937_64& random, WideBounded<double>*) {
  const Wide x = draw_wide(random);
  const double error = random() % 3 == 0 ? 0 : std::abs(draw(random)) * 0x1p-90;
  const Q share(double(random() % 2001) / 1000 - 1);
  return {{x, error}, exact(x) + share * Q(error)};
}

template <class N>
class NumberWithBound : public testing::Test {};
using NumbersWithBound = testing::Types<Bounded<double>, WideBounded<double>>;
TYPED_TEST_SUITE(NumberWithBound, NumbersWithBound);

/// |value - truth| <= error, up to the rounding of the error itself; a number marked as doubtful passes.
template <class N>
void expect_within(const N& n, const Q& truth, const char* operation) {
  if (Doubt::any) return;
  ASSERT_LE(Q(abs(exact(n.value) - truth)), Q(n.error) * Q(N::slack)) << operation;
}

TYPED_TEST(NumberWithBound, EnclosesTheExactResultOfEachOperation) {
  using N = TypeParam;
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const auto a = draw_known(random, static_cast<N*>(nullptr)), b = draw_known(random, static_cast<N*>(nullptr));
    Doubt::any = false;
    expect_within(a.number + b.number, a.truth + b.truth, "+");
    expect_within(a.number - b.number, a.truth - b.truth, "-");
    expect_within(a.number * b.number, a.truth * b.truth, "*");
    expect_within(abs(a.number), abs(a.truth), "abs");
    expect_within(larger(a.number, b.number), std::max(a.truth, b.truth), "larger");
    expect_within(smaller(a.number, b.number), std::min(a.truth, b.truth), "smaller");
    ASSERT_FALSE(Doubt::any) << "sums and products are never in doubt";
    if (b.truth != 0) expect_within(a.number / b.number, a.truth / b.truth, "/");
    Doubt::any = false;
    if (a.truth > 0) {
      const N root = sqrt(a.number);
      if (Doubt::any) continue;
      const Q low = exact(root.value) - Q(root.error), high = exact(root.value) + Q(root.error);
      ASSERT_TRUE((low <= 0 || low * low <= a.truth) && high * high >= a.truth) << "sqrt";
    }
  }
}

TYPED_TEST(NumberWithBound, ComparesRightlyOrRecordsADoubt) {
  using N = TypeParam;
  std::mt19937_64 random(2);
  int doubts = 0, equal = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto a = draw_known(random, static_cast<N*>(nullptr));
    auto b = random() % 2 == 0 ? draw_known(random, static_cast<N*>(nullptr)) : a;
    Doubt::any = false;
    const bool less = a.number < b.number, at_most = a.number <= b.number, same = a.number == b.number;
    if (Doubt::any) {
      ++doubts;
      ASSERT_TRUE(a.number.error > 0 || b.number.error > 0) << "exact numbers are never in doubt";
      continue;
    }
    equal += same;
    ASSERT_EQ(less, a.truth < b.truth);
    ASSERT_EQ(at_most, a.truth <= b.truth);
    ASSERT_EQ(same, a.truth == b.truth);
  }
  EXPECT_GT(doubts, 1000);
  EXPECT_GT(equal, 1000);
}

/// A kernel with cancellation, divisions and a root.
template <class N>
N text(const std::array<N, 6>& x) {
  const N d = x[0] * x[3] - x[1] * x[2], e = (x[4] - x[5]) / (x[2] * x[2] + N(1));
  return sqrt(d * d + e * e + N(1)) - e * d;
}

TEST(LongerNumbers, KeepTheBoundsOfDoublesTimesTheRatio) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    std::array<double, 6> x;
    for (double& number : x) number = std::ldexp(double(random() >> 11), -52) - 1;
    const auto in = [&]<class N>(N) {
      std::array<N, 6> inputs;
      for (std::size_t k = 0; k < 6; ++k) inputs[k] = N(x[k]);
      return text(inputs);
    };
    Doubt::any = false;
    const Bounded<double> bounded = in(Bounded<double>());
    const auto words = in(detail::HighPrecision<double, Wide>()).value;
    const WideBounded<double> reference = in(WideBounded<double>());
    ASSERT_FALSE(Doubt::any);
    const Q truth = exact(reference.value), slack(reference.error);
    ASSERT_LE(Q(abs(exact(bounded.value) - truth)), Q(bounded.error) + slack);
    ASSERT_LE(Q(abs(exact(words) - truth)), Q(bounded.error) * Q(detail::double_word_ratio) + slack);
    if constexpr (detail::has_long_double) {
      const long double longer = in(detail::HighPrecision<double, long double>()).value;
      const Q value = Q(double(longer)) + Q(double(longer - static_cast<long double>(double(longer))));
      ASSERT_LE(Q(abs(value - truth)), Q(bounded.error) * Q(detail::long_double_ratio) + slack);
    }
  }
}

TEST(DoubleWords, DivideAndTakeRootsToTwiceThePrecision) {
  std::mt19937_64 random(4);
  const Q bound(0x1p-99);
  for (int i = 0; i < 100000; ++i) {
    const Wide a = draw_wide(random), b = draw_wide(random);
    if (b.high != 0) {
      const Q truth = exact(a) / exact(b);
      ASSERT_LE(Q(abs(exact(a / b) - truth)), abs(truth) * bound);
    }
    if (a.high > 0) {
      const Q root = exact(sqrt(a)), low = root * (1 - bound), high = root * (1 + bound);
      ASSERT_TRUE(low * low <= exact(a) && exact(a) <= high * high);
    }
  }
}

TEST(CompensatedSums, LoseOnlyWhatTwiceThePrecisionLoses) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 100000; ++i) {
    const Vec3<double> a{draw(random), draw(random), draw(random)};
    Vec3<double> b{draw(random), draw(random), draw(random)};
    if (random() % 2 == 0 && a.z != 0) b.z = -(a.x * b.x + a.y * b.y) / a.z;  // nearly perpendicular
    const Q allowed_of_result(0x1p-50), allowed_of_terms(0x1p-100);
    const Q dot = Q(a.x) * Q(b.x) + Q(a.y) * Q(b.y) + Q(a.z) * Q(b.z);
    ASSERT_LE(Q(abs(Q(Compensated::dot(a, b)) - dot)),
              abs(dot) * allowed_of_result +
                  (abs(Q(a.x) * Q(b.x)) + abs(Q(a.y) * Q(b.y)) + abs(Q(a.z) * Q(b.z))) * allowed_of_terms);
    const Q difference = Q(a.x) * Q(b.y) - Q(a.y) * Q(b.x);
    ASSERT_LE(Q(abs(Q(Compensated::difference_of_products(a.x, b.y, a.y, b.x)) - difference)),
              abs(difference) * allowed_of_result + (abs(Q(a.x) * Q(b.y)) + abs(Q(a.y) * Q(b.x))) * allowed_of_terms);
    const double r = std::sqrt(Plain::dot(a, a)) * (random() % 2 == 0 ? 1 : 0.5);
    const Q beyond = Q(a.x) * Q(a.x) + Q(a.y) * Q(a.y) + Q(a.z) * Q(a.z) - Q(r) * Q(r);
    ASSERT_LE(Q(abs(Q(Compensated::beyond_radius(a, r)) - beyond)),
              abs(beyond) * allowed_of_result + Q(r) * Q(r) * 8 * allowed_of_terms);
  }
}

class RealNumbers : public testing::Test {
 protected:
  using R = Real<double>;
  ~RealNumbers() override { detail::clear_expressions(); }
};

TEST_F(RealNumbers, KnowWhenNestedRootsAreEqual) {
  EXPECT_TRUE(sqrt(R(2)) * sqrt(R(2)) == R(2));
  EXPECT_TRUE(sqrt(R(2)) + sqrt(R(3)) == sqrt(R(5) + R(2) * sqrt(R(6))));
  EXPECT_TRUE(sqrt(R(5) - R(2) * sqrt(R(6))) == sqrt(R(3)) - sqrt(R(2)));
  EXPECT_TRUE(R(1) / (sqrt(R(3)) - sqrt(R(2))) == sqrt(R(3)) + sqrt(R(2)));
  EXPECT_FALSE(sqrt(R(2)) + sqrt(R(3)) == sqrt(R(5) + R(2) * sqrt(R(6.000000000000001))));
}

TEST_F(RealNumbers, CompareSumsOfRootsThatAgreeToManyDigits) {
  // sqrt(n + 1) + sqrt(n - 1) < 2 sqrt(n), by about n^(-3/2) / 4.
  for (const double n : {10.0, 1e6, 1e15}) {
    EXPECT_TRUE(sqrt(R(n + 1)) + sqrt(R(n - 1)) < R(2) * sqrt(R(n))) << n;
  }
}

TEST_F(RealNumbers, KeepWhatIsAThousandOrdersSmaller) {
  const R huge(0x1p1023), tiny(0x1p-1074);
  EXPECT_TRUE(huge + tiny > huge);
  EXPECT_TRUE((huge + tiny) - huge == tiny);
  EXPECT_TRUE(sqrt(huge * huge + tiny) > huge);
  EXPECT_TRUE(huge * huge * huge * tiny / huge / huge / tiny == huge);
}

TEST_F(RealNumbers, AgreeWithRationals) {
  std::mt19937_64 random(6);
  for (int i = 0; i < 2000; ++i) {
    const double x = draw(random), y = draw(random), z = draw(random), w = draw(random);
    const Q left = Q(x) * Q(y) - Q(z), right = Q(w) * Q(w) + Q(x);
    const R a = R(x) * R(y) - R(z), b = R(w) * R(w) + R(x);
    ASSERT_EQ(a < b, left < right);
    ASSERT_EQ(a == b, left == right);
    ASSERT_TRUE((R(x) + R(y)) * (R(x) - R(y)) == R(x) * R(x) - R(y) * R(y));
    if (b == R(0)) continue;
    const Q quotient = left / right;
    ASSERT_LE(Q(abs(Q((a / b).rounded()) - quotient)), abs(quotient) * Q(0x1p-52));
  }
}

TEST_F(RealNumbers, StartAnewInMemoryThatWasUsedBefore) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 300; ++i) {
    const double x = draw(random), y = draw(random);
    const double n = 10 + double(random() % 1000);
    ASSERT_EQ(R(x) * R(x) + R(y) < R(y) * R(y) + R(x), Q(x) * Q(x) + Q(y) < Q(y) * Q(y) + Q(x));
    ASSERT_TRUE(sqrt(R(n + 1)) + sqrt(R(n - 1)) < R(2) * sqrt(R(n))) << n;
    ASSERT_TRUE((R(0x1p1023) + R(n)) - R(0x1p1023) == R(n));
    ASSERT_TRUE(sqrt(R(n)) * sqrt(R(n)) == R(n));
    detail::clear_expressions();
  }
}

/// [low, high] of few bits, at a precision that holds them.
void set(detail::BigInterval& to, double low, double high) {
  to.set_precision(64);
  mpfr_set_d(to.low, low, MPFR_RNDD);
  mpfr_set_d(to.high, high, MPFR_RNDU);
}
/// The least and the largest of the results at the ends of two intervals, rounded outward to `precision` bits.
void expect_ends(const detail::BigInterval& given, std::array<Q, 4> results, mpfr_prec_t precision) {
  const auto [least, largest] = std::minmax_element(results.begin(), results.end());
  mpfr_t end;
  mpfr_init2(end, precision);
  mpfr_set_q(end, least->get_mpq_t(), MPFR_RNDD);
  ASSERT_TRUE(mpfr_equal_p(given.low, end));
  mpfr_set_q(end, largest->get_mpq_t(), MPFR_RNDU);
  ASSERT_TRUE(mpfr_equal_p(given.high, end));
  mpfr_clear(end);
}

TEST(BigIntervals, HaveTheEndsOfProductsAndQuotients) {
  constexpr mpfr_prec_t precision = 8;  // rounds most results
  std::mt19937_64 random(8);
  detail::BigInterval x, y, result;
  for (int i = 0; i < 5000; ++i) {
    const auto pair = [&] { return std::minmax({double(random() % 33) - 16, double(random() % 33) - 16}); };
    const auto [a, b] = pair();
    const auto [c, d] = pair();
    set(x, a, b);
    set(y, c, d);
    result.set_precision(precision);
    detail::multiply(result, x, y);
    expect_ends(result, {Q(a) * Q(c), Q(a) * Q(d), Q(b) * Q(c), Q(b) * Q(d)}, precision);
    if (c <= 0 && d >= 0) continue;
    detail::divide(result, x, y);
    expect_ends(result, {Q(a) / Q(c), Q(a) / Q(d), Q(b) / Q(c), Q(b) / Q(d)}, precision);
  }
}

TEST_F(RealNumbers, ThatAreInvalidCompareWithNothing) {
  for (const R& x : {R(0) / R(0), sqrt(R(-1)), R(std::nan("")), std::numeric_limits<R>::infinity() - R(1)}) {
    EXPECT_FALSE(x < R(1) || x > R(1) || x == R(1) || x <= x || x >= x);
  }
  EXPECT_TRUE(R(1) < std::numeric_limits<R>::infinity());
}

}  // namespace
}  // namespace collide
