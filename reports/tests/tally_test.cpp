/// Counts, retention of findings, and formats of numbers.
#include <gtest/gtest.h>

#include "reports/engine/answer_sample.hpp"
#include "reports/engine/tally.hpp"
#include "reports/findings/breakage.hpp"
#include "reports/findings/text.hpp"

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
  const Subject s{.name = "s", .version = "1", .scalar = Scalar::float64, .offerings = {}};
  Tally t = tally_of(s);
  for (int i = 0; i < 3; ++i) t.count(violation(Disagreement::false_hit, 4));
  for (int i = 0; i < 5; ++i) t.count(violation(Disagreement::false_miss, 1 << i));
  EXPECT_EQ(t.violations[std::size_t(Disagreement::false_hit)], 3u);
  EXPECT_EQ(t.violations[std::size_t(Disagreement::false_miss)], 5u);
  EXPECT_EQ(t.of(Verdict::violates_contract), 8u);
  EXPECT_EQ(t.worst_backward, 16);
}

MemberFinding breaking(Disagreement d, int member, double above) {
  MemberFinding m;
  m.member = member;
  m.disagreement = d;
  m.backward = Backward{above};
  m.broken = Clause::backward;
  m.clause = "backward error at most 8 epsilon";
  return m;
}

/// An answer with a wrong time and a wrong normal; the normal is the headline.
Finding two_violations(double above_of_time) {
  Finding f = violation(Disagreement::wrong_normal, 1024);
  f.members = {breaking(Disagreement::wrong_time, 0, above_of_time), breaking(Disagreement::wrong_normal, 2, 1024)};
  f.headline = 1;
  return f;
}

TEST(Tally, CountsByMember) {
  const Subject s{.name = "s", .version = "1", .scalar = Scalar::float64, .offerings = {}};
  Tally t = tally_of(s);
  t.count(two_violations(16));
  EXPECT_EQ(t.violations[std::size_t(Disagreement::wrong_time)], 1u);
  EXPECT_EQ(t.violations[std::size_t(Disagreement::wrong_normal)], 1u);
  EXPECT_EQ(t.wrong, 1u);
  EXPECT_EQ(t.bad(), 1u);
}

TEST(AnswerSample, TakesEveryAnswerOfASubjectThatIsRarelyWrong) {
  AnswerSample sample;
  for (std::uint64_t i = 0; i < 4 * AnswerSample::judged_at_first; ++i) {
    ASSERT_TRUE(sample.takes_next()) << i;
    sample.count(i % 6 == 0);
  }
}

TEST(AnswerSample, TakesFewerOfOneThatIsOftenWrong) {
  AnswerSample sample;
  for (std::uint64_t i = 0; i < AnswerSample::judged_at_first; ++i) {
    ASSERT_TRUE(sample.takes_next()) << i;
    sample.count(i % 4 == 0);
  }
  std::uint64_t taken = 0;
  for (std::uint64_t i = 0; i < 100 * AnswerSample::one_in; ++i) {
    if (!sample.takes_next()) continue;
    ++taken;
    sample.count(true);
  }
  EXPECT_EQ(taken, 100u);
}

TEST(FindingRetention, KeepsAFaultThatACommonerOneHides) {
  const Subject s{.name = "s", .version = "1", .scalar = Scalar::float64, .offerings = {}};
  const Tally t = tally_of(s);
  FindingRetention retention;
  for (std::uint64_t i = 0; i < 3 * FindingRetention::first_few; ++i)
    retention.keep(t, violation(Disagreement::wrong_normal, 1024));
  Finding normal_alone = two_violations(16);
  normal_alone.members.erase(normal_alone.members.begin());
  normal_alone.headline = 0;
  for (std::uint64_t i = 0; i < FindingRetention::first_few; ++i) EXPECT_TRUE(retention.keep(t, normal_alone));
  EXPECT_FALSE(retention.keep(t, normal_alone));
  EXPECT_TRUE(retention.keep(t, two_violations(16)));
}

TEST(Tally, CountsTruthOnlyWhereItWasAskedFor) {
  const Subject s{.name = "s", .version = "1", .scalar = Scalar::float64, .offerings = {}};
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

TEST(FindingRetention, KeepsTheFirstFewThenOnlyTheMuchWorse) {
  const Subject s{.name = "s", .version = "1", .scalar = Scalar::float64, .offerings = {}};
  const Tally t = tally_of(s);
  FindingRetention retention;
  for (std::uint64_t i = 0; i < FindingRetention::first_few; ++i)
    EXPECT_TRUE(retention.keep(t, violation(Disagreement::false_hit, 4)));
  EXPECT_FALSE(retention.keep(t, violation(Disagreement::false_hit, 4)));
  EXPECT_TRUE(retention.keep(t, violation(Disagreement::false_hit, 8)));
  EXPECT_FALSE(retention.keep(t, violation(Disagreement::false_hit, 8)));
  EXPECT_TRUE(retention.keep(t, violation(Disagreement::false_hit, 64)));
  EXPECT_FALSE(retention.keep(t, violation(Disagreement::false_hit, 32)));
  EXPECT_TRUE(retention.keep(t, violation(Disagreement::false_miss, 0))) << "another fault has its own first few";
}

Finding breakage(const std::string& reason) {
  Finding f;
  f.verdict = Verdict::broke;
  f.clause = reason;
  f.cause = cause_in_report(reason, false);
  return f;
}

std::string assertion(int line) {
  return "killed by signal 6 (Aborted): nearmiss: ./include/gjk-inl.h:" + std::to_string(line) +
         ": int f(): Assertion `";
}

TEST(FindingRetention, KeepsTheFirstFewOfEachReasonToBreak) {
  const Subject s{.name = "s", .version = "1", .scalar = Scalar::float64, .offerings = {}};
  Tally t = tally_of(s);
  FindingRetention retention;
  const auto keeps = [&](const std::string& reason) {
    t.count(breakage(reason));
    return retention.keep(t, breakage(reason));
  };
  for (std::uint64_t i = 0; i < FindingRetention::first_few; ++i) EXPECT_TRUE(keeps(assertion(1643)));
  EXPECT_FALSE(keeps(assertion(1643)));
  EXPECT_TRUE(keeps(assertion(1644))) << "a rarer one is not hidden by the commonest";
  EXPECT_TRUE(keeps("exception: no root between 0.25 and 3"));
  EXPECT_EQ(t.breakages.at("killed by signal 6 (Aborted) at gjk-inl.h:1643"), FindingRetention::first_few + 1);
  EXPECT_EQ(t.breakages.at("killed by signal 6 (Aborted) at gjk-inl.h:1644"), 1u);
  EXPECT_EQ(t.breakages.at("exception: no root between N and N"), 1u);
}

TEST(Tally, KnowsSoManyReasonsAndNoMore) {
  const Subject s{.name = "s", .version = "1", .scalar = Scalar::float64, .offerings = {}};
  Tally t = tally_of(s);
  for (int line = 0; line < 100; ++line) t.count(breakage(assertion(line)));
  t.count(breakage(assertion(0)));
  EXPECT_EQ(t.breakages.size(), Tally::most_kinds + 1);
  EXPECT_EQ(t.breakages.at(Tally::other_kind), 100 - Tally::most_kinds);
  EXPECT_EQ(t.breakages.at("killed by signal 6 (Aborted) at gjk-inl.h:0"), 2u);
}

TEST(Breakage, IsToldByItsReason) {
  const auto kind = [](std::string_view reason) { return kind_of_breakage(reason, cause_in_report(reason, false)); };
  EXPECT_EQ(kind("killed by signal 11 (Segmentation fault)"), "killed by signal 11 (Segmentation fault)");
  EXPECT_EQ(kind_of_breakage("no answer within 2.000 s", BreakCause::time_limit), "no answer in time");
  EXPECT_EQ(kind_of_breakage("no hello within 2.000 s", BreakCause::time_limit), "no answer in time");
  EXPECT_EQ(kind("no answer within reach"), "no answer within reach") << "a subject's own words";
  EXPECT_EQ(kind("memory limit reached"), "memory limit reached");
  EXPECT_EQ(kind("left with exit code 3"), "left with exit code 3");
  EXPECT_EQ(kind("killed by signal 6 (Aborted): nearmiss: ./include/fcl/narrowphase/distance-inl.h:163: typename"),
            "killed by signal 6 (Aborted) at distance-inl.h:163");
  EXPECT_EQ(kind("killed by signal 6 (Aborted): ODE INTERNAL ERROR 1: assertion \"!bad\" failed in f() [odemath.h:41]"),
            "killed by signal 6 (Aborted) at odemath.h:41");
  EXPECT_EQ(kind("exception: /usr/include/fcl/gjk_libccd-inl.h:(1643): supportEPADirection(): at (0.25, -1e-17)"),
            "exception at gjk_libccd-inl.h:1643");
  EXPECT_EQ(kind("exception: no root in [-1.5e-300, +nan] of vec3, see 12:30, 0x1fp-3 or -inf"),
            "exception: no root in [N, N] of vec3, see N:N, N or N");
  EXPECT_EQ(kind("exception: " + std::string(300, 'x')).size(), 80u);
  EXPECT_EQ(kind(""), "no reason given");
  EXPECT_EQ(kind_of_breakage("killed by signal 6 at x", BreakCause::other), "killed by signal N at x")
      << "the cause decides, not the words";
}

TEST(Text, TellsEpsilonsAndTheirShare) {
  EXPECT_EQ(epsilons_text(0), "0");
  EXPECT_EQ(epsilons_text(8), "8");
  EXPECT_EQ(epsilons_text(0x1p46), "2^46");
  EXPECT_EQ(amount_text(0x1p46, Scalar::float64), "0.78 % of the largest number of its group, 2^46 epsilon");
  EXPECT_EQ(amount_text(4, Scalar::float64), "4.4e-16 times the largest number of its group, 4 epsilon");
}

TEST(Text, GroupsDigitsAndMakesPlurals) {
  EXPECT_EQ(count_text(0), "0");
  EXPECT_EQ(count_text(999), "999");
  EXPECT_EQ(count_text(1000), "1,000");
  EXPECT_EQ(count_text(1234567), "1,234,567");
  EXPECT_EQ(plural_text(1, "false miss"), "1 false miss");
  EXPECT_EQ(plural_text(2, "false miss"), "2 false misses");
  EXPECT_EQ(plural_text(6, "query"), "6 queries");
  EXPECT_EQ(plural_text(1, "query"), "1 query");
  EXPECT_EQ(plural_text(2, "day"), "2 days");
}

TEST(Text, EndsAShortenedTextAtAWord) {
  EXPECT_EQ(first_words("killed by signal 6", 18), "killed by signal 6");
  EXPECT_EQ(first_words("killed by signal 6", 17), "killed by ...");
  EXPECT_EQ(first_words("killed by signal 6", 13), "killed by ...");
  EXPECT_EQ(first_words("killed by signal 6", 12), "killed ...");
  EXPECT_EQ(first_words("aVeryLongWordIndeed", 10), "aVeryL ...");
  EXPECT_EQ(first_words("\xc3\xa4\xc3\xb6\xc3\xbc\xc3\xa4\xc3\xb6", 9), "\xc3\xa4\xc3\xb6 ...");
}

TEST(Text, FindsCloseMatchesOnly) {
  const std::vector<std::string> words{"moving_sphere_box", "box_box_overlap", "bounce_direction"};
  EXPECT_EQ(close_matches("moving_spere_box", words), std::vector<std::string>{"moving_sphere_box"});
  EXPECT_EQ(close_matches("overlap", words), std::vector<std::string>{"box_box_overlap"});
  EXPECT_TRUE(close_matches("zzz", words).empty());
}

}  // namespace
}  // namespace nearmiss
