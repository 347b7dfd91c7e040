/// The arithmetic that every result rests on: checked at start, in every rounding mode on entry.
#include <gtest/gtest.h>

#include <cfenv>

#include "oracles/environment.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {
namespace {

class RoundingMode : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { std::fesetround(GetParam()); }
  void TearDown() override { std::fesetround(FE_TONEAREST); }
};

TEST_P(RoundingMode, TheSelfCheckPassesAndKeepsTheMode) {
  const auto broken = broken_environment();
  const int after = std::fegetround();
  std::fesetround(FE_TONEAREST);
  EXPECT_FALSE(broken) << *broken;
  EXPECT_EQ(after, GetParam());
}

TEST_P(RoundingMode, TheJudgeSaysTheSameAndKeepsTheMode) {
  // A third of the way: t = 1/3, x = 1/3, neither of which is a double.
  const Case c{find_query("closest_point_segment"), Scalar::float64, {0, 0, 0, 3, 0, 0, 1.0 / 3, 5, 5}, "", 0, 0, {}};
  Answer right, wrong;
  right.yes = wrong.yes = true;
  right.values = {1.0 / 3};
  wrong.values = {1.0 / 3 + 0x1p-52};
  const collide::Contract contract{.forward = 2};
  const Finding agrees = judge(c, right, contract, Detail::full), differs = judge(c, wrong, contract, Detail::full);
  const int after = std::fegetround();
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(agrees.verdict, Verdict::agrees);
  EXPECT_EQ(differs.verdict, Verdict::violates_contract);
  EXPECT_EQ(after, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Every, RoundingMode, testing::Values(FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO));

}  // namespace
}  // namespace nearmiss
