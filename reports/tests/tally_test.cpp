/// What is counted, what is kept, and how numbers are told.
#include <gtest/gtest.h>

#include "reports/tally.hpp"
#include "reports/text.hpp"

namespace nearmiss {
namespace {

Finding violation(Disagreement d, double above) {
  Finding f;
  f.verdict = Verdict::violates_contract;
  f.disagreement = d;
  f.backward = Backward{above};
  return f;
}

Tally tally_of(const Subject& subject) { return {&catalogue()[0], &subject}; }

TEST(Tally, NeverAddsFalseHitsToFalseMisses) {
  const Subject s{"s", "", Scalar::float64, false, {}};
  Tally t = tally_of(s);
  for (int i = 0; i < 3; ++i) t.count(violation(Disagreement::false_hit, 4));
  for (int i = 0; i < 5; ++i) t.count(violation(Disagreement::false_miss, 1 << i));
  EXPECT_EQ(t.violations[std::size_t(Disagreement::false_hit)], 3u);
  EXPECT_EQ(t.violations[std::size_t(Disagreement::false_miss)], 5u);
  EXPECT_EQ(t.of(Verdict::violates_contract), 8u);
  EXPECT_EQ(t.worst_backward, 16);
}

TEST(Tally, CountsTruthOnlyWhereItWasAskedFor) {
  const Subject s{"s", "", Scalar::float64, false, {}};
  Tally t = tally_of(s);
  Finding f;
  f.truth_yes = true;
  f.decided_by = Stage::exact;
  t.count(f);
  f.verdict = Verdict::broke;
  t.count(f);
  f.verdict = Verdict::cannot_answer;
  t.count(f);
  EXPECT_EQ(t.cases, 3u);
  EXPECT_EQ(t.decided(), 1u);
  EXPECT_EQ(t.truth_yes, 1u);
  EXPECT_EQ(t.bad(), 1u);
}

TEST(Keeper, KeepsTheFirstFewThenOnlyTheMuchWorse) {
  const Subject s{"s", "", Scalar::float64, false, {}};
  const Tally t = tally_of(s);
  Keeper keeper;
  for (std::uint64_t i = 0; i < Keeper::first_few; ++i)
    EXPECT_TRUE(keeper.keep(t, violation(Disagreement::false_hit, 4)));
  EXPECT_FALSE(keeper.keep(t, violation(Disagreement::false_hit, 4)));
  EXPECT_TRUE(keeper.keep(t, violation(Disagreement::false_hit, 8)));
  EXPECT_FALSE(keeper.keep(t, violation(Disagreement::false_hit, 8)));
  EXPECT_TRUE(keeper.keep(t, violation(Disagreement::false_hit, 64)));
  EXPECT_FALSE(keeper.keep(t, violation(Disagreement::false_hit, 32)));
  EXPECT_TRUE(keeper.keep(t, violation(Disagreement::false_miss, 0))) << "another fault has its own first few";
}

TEST(Keeper, KeepsOnlyTheFirstFewThatBroke) {
  const Subject s{"s", "", Scalar::float64, false, {}};
  const Tally t = tally_of(s);
  Finding broke;
  broke.verdict = Verdict::broke;
  Keeper keeper;
  for (std::uint64_t i = 0; i < Keeper::first_few; ++i) EXPECT_TRUE(keeper.keep(t, broke));
  EXPECT_FALSE(keeper.keep(t, broke));
}

TEST(Text, ShowsTheShortestDecimalWithinTightBounds) {
  EXPECT_EQ(bounds_text({0.6625 - 1e-16, 0.6625 + 1e-16}), "0.6625");
  EXPECT_EQ(bounds_text({0.1, 0.1}), "0.1");
  EXPECT_EQ(bounds_text({1.0 / 3, std::nextafter(1.0 / 3, 1)}), "0.33333333333333334");
  EXPECT_EQ(bounds_text({1, 2}), "between 1 and 2");
}

TEST(Text, TellsEpsilonsAndTheirShare) {
  EXPECT_EQ(epsilons_text(0), "0");
  EXPECT_EQ(epsilons_text(8), "8");
  EXPECT_EQ(epsilons_text(0x1p46), "2^46");
  EXPECT_EQ(amount_text(0x1p46, Scalar::float64), "0.78 % of the largest number in its group (2^46 epsilon)");
  EXPECT_EQ(amount_text(4, Scalar::float64), "4.4e-16 times the largest number in its group (4 epsilon)");
}

TEST(Text, GroupsDigitsAndMakesPlurals) {
  EXPECT_EQ(count_text(0), "0");
  EXPECT_EQ(count_text(999), "999");
  EXPECT_EQ(count_text(1000), "1,000");
  EXPECT_EQ(count_text(1234567), "1,234,567");
  EXPECT_EQ(plural_text(1, "false miss"), "1 false miss");
  EXPECT_EQ(plural_text(2, "false miss"), "2 false misses");
}

TEST(Text, FindsCloseMatchesOnly) {
  const std::vector<std::string> words{"moving_sphere_box", "box_box_overlap", "bounce_direction"};
  EXPECT_EQ(close_matches("moving_spere_box", words), std::vector<std::string>{"moving_sphere_box"});
  EXPECT_EQ(close_matches("overlap", words), std::vector<std::string>{"box_box_overlap"});
  EXPECT_TRUE(close_matches("zzz", words).empty());
}

}  // namespace
}  // namespace nearmiss
