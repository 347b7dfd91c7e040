/// The arithmetic that every result rests on: checked at start, in every rounding mode on entry.
#include <gtest/gtest.h>

#include <cfenv>

#include "corpus/generator.hpp"
#include "impl/subject/subject.hpp"
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

bool same(const Bounds& a, const Bounds& b) { return (a.empty() && b.empty()) || (a.low == b.low && a.high == b.high); }

/// Each query's oracle, both stages: the mode that it is entered in changes no bit.
TEST_P(RoundingMode, EveryQueryIsJudgedTheSame) {
  constexpr std::uint64_t cases = 40;
  int by_exact = 0, wrong = 0;
  for (const Query& query : catalogue()) {
    for (std::uint64_t i = 0; i < cases; ++i) {
      std::fesetround(FE_TONEAREST);
      const Case c = generate(query, i % 2 ? Scalar::float32 : Scalar::float64, 14, i);
      const Subject& fast = *find_subject(i % 2 ? "collide-fast-float" : "collide-fast-double");
      const Offering& offering = fast.offering(query.name);
      Answer answer = offering.answer(c.values);
      if (i % 4 > 1) answer.yes = !answer.yes;
      const Finding f = judge(c, answer, offering.contract, Detail::full);
      const Truth t = truth_of(c);
      std::fesetround(GetParam());
      const Finding g = judge(c, answer, offering.contract, Detail::full);
      const Truth u = truth_of(c);
      const int after = std::fegetround();
      std::fesetround(FE_TONEAREST);
      ASSERT_EQ(after, GetParam());
      ASSERT_TRUE(f.verdict == g.verdict && f.disagreement == g.disagreement && f.truth_yes == g.truth_yes &&
                  f.decided_by == g.decided_by && f.clause == g.clause && f.worst == g.worst &&
                  f.forward_ulps == g.forward_ulps && f.forward_absolute == g.forward_absolute &&
                  f.unit_error == g.unit_error && f.backward.has_value() == g.backward.has_value() &&
                  (!f.backward || f.backward->above == g.backward->above))
          << query.name << ", case " << i;
      ASSERT_TRUE(t.yes == u.yes && t.margin_at_least == u.margin_at_least && t.alternatives.size() == u.alternatives.size())
          << query.name << ", case " << i;
      for (std::size_t k = 0; k < t.alternatives.size(); ++k) {
        for (std::size_t n = 0; n < query.outputs.size(); ++n) {
          ASSERT_TRUE(same(t.alternatives[k].values[n], u.alternatives[k].values[n])) << query.name << ", case " << i;
        }
      }
      by_exact += f.decided_by == Stage::exact;
      wrong += f.backward.has_value();
    }
  }
  EXPECT_GT(by_exact, 0);
  EXPECT_GT(wrong, 100);
}

INSTANTIATE_TEST_SUITE_P(Every, RoundingMode, testing::Values(FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO));

}  // namespace
}  // namespace nearmiss
