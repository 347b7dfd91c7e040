/// Answers derived by hand: the judge accepts each right one and refutes each wrong one. properties/hand_derived/ has
/// the answers, with their derivations. The inputs are small integers, so that the right answers are exact.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "corpus/files/source_folder.hpp"
#include "oracles/judge.hpp"
#include "properties/hand_derived.hpp"
#include "properties/support.hpp"

namespace nearmiss {

void PrintTo(const HandDerived& hand, std::ostream* out) { *out << hand.where; }

namespace {

const std::map<std::string, HandDerivedFile>& files() {
  static const auto all = read_hand_derived(source_folder() + "/properties/hand_derived");
  return all;
}

std::vector<HandDerived> all_answers() {
  std::vector<HandDerived> all;
  for (const auto& [query, file] : files()) all.insert(all.end(), file.answers.begin(), file.answers.end());
  return all;
}

class ByHand : public testing::TestWithParam<HandDerived> {};

TEST_P(ByHand, TheJudgeKnows) {
  const HandDerived& hand = GetParam();
  const Case c{hand.query, Scalar::float64, hand.inputs, "hand", 0, 0, {}};
  const Finding f = judge(c, hand.answer, strict, Detail::full);
  EXPECT_EQ(name_of(f.verdict), name_of(hand.right ? Verdict::agrees : Verdict::violates_contract))
      << hand.where << ": " << name_of(f.disagreement) << ", " << f.forward_ulps << " ulp, " << f.clause;
}

INSTANTIATE_TEST_SUITE_P(Derived, ByHand, testing::ValuesIn(all_answers()), [](const auto& test) {
  return fmt::format("{}_{}", test.param.query->name, test.param.name);
});

TEST(HandDerivedCases, AreWellFormed) {
  for (const auto& [query, file] : files()) {
    for (const std::string& error : file.errors) ADD_FAILURE() << error;
  }
}

TEST(HandDerivedCases, EveryClassOfEveryQueryHasARightAnswerAndEveryQueryAWrongOne) {
  for (const auto& [query, file] : files()) {
    std::set<std::string> right;
    bool has_wrong = false;
    for (const HandDerived& hand : file.answers) {
      if (hand.right) right.insert(hand.class_name());
      has_wrong = has_wrong || !hand.right;
    }
    EXPECT_EQ(right, file.classes) << query;
    EXPECT_TRUE(has_wrong) << query;
  }
}

/// What the parser says of lines of moving_point_plane.
std::vector<std::string> errors_of(const std::string& lines) {
  return parse_hand_derived(*find_query("moving_point_plane"), "file", lines).errors;
}

const std::string good_classes = "classes  hit\n";
const std::string good_given =
    "given  point = (1, 2, 5); velocity = (0, 0, -2); plane.normal = (0, 0, 2); plane.offset = -2\n";
const std::string good_answer = "right  hit_down: hit; time = 2; location = (1, 2, 1); normal = (0, 0, 1)\n";

TEST(HandDerivedParser, ReadsNumbersOfEveryForm) {
  const std::string text = good_classes +
                           "common  plane = (0, 0, 2), -2  \n"
                           "# a comment\n"
                           "given  point = (1, 2.5, 2 + 2^-51); plane.offset = 0;\n"
                           "       velocity = (sqrt(1/2), -sqrt(1/2), 2^10)\n"
                           "wrong  hit_none: miss; time = inf\n";
  const HandDerivedFile file = parse_hand_derived(*find_query("moving_point_plane"), "file", text);
  EXPECT_EQ(file.errors, std::vector<std::string>{});
  ASSERT_EQ(file.answers.size(), 1u);
  const HandDerived& hand = file.answers.front();
  const double r = std::sqrt(0.5);
  EXPECT_EQ(hand.inputs, (std::vector<double>{1, 2.5, 2 + 0x1p-51, r, -r, 1024, 0, 0, 2, 0}));
  EXPECT_FALSE(hand.right);
  EXPECT_FALSE(hand.answer.yes);
  EXPECT_EQ(hand.answer.given, 1u);
  EXPECT_EQ(hand.answer.values[0], std::numeric_limits<double>::infinity());
  EXPECT_EQ(hand.where, "file:6");
}

TEST(HandDerivedParser, RefusesBadLines) {
  const auto given = [](const std::string& what) { return good_classes + "given  " + what + "\n" + good_answer; };
  const auto answer = [](const std::string& line) { return good_classes + good_given + line + "\n"; };
  const std::string rest = "; velocity = (0, 0, -2); plane = (0, 0, 2), -2";
  const std::map<std::string, std::string> error_of{
      {good_given + good_answer, "file:3: the file has no line \"classes\""},
      {good_classes + "classes  hot\n" + good_given + good_answer, "file:2: \"hot\" is no class"},
      {good_classes + good_classes + good_given + good_answer, "file:2: hit stands twice"},
      {good_classes + "Given  x\n", "file:2: \"Given\" is none of classes, common, given, right, wrong"},
      {good_classes + good_answer, "file:2: no line \"given\" is before this answer"},
      {good_classes + good_given + good_given + good_answer, "file:2: no answer follows these inputs"},
      {good_classes + good_given, "file:2: no answer follows these inputs"},
      {given("point = (1, 2, 5)"), "file:2: velocity is missing"},
      {given("point (1, 2, 5)" + rest), "file:2: \"point (1, 2, 5)\" is not NAME = VALUE"},
      {given("place = (1, 2, 5)" + rest), "file:2: the query has no number \"place\""},
      {given("point = (1, 2)" + rest), "file:2: point has 3 numbers, not 2"},
      {given("point = (1, 2, 5, 7)" + rest), "file:2: point has 3 numbers, not 4"},
      {given("point = 1, 2, 5" + rest), "file:2: point is not a vector (x, y, …)"},
      {given("point = (1, 2, 5), 7" + rest), "file:2: point has too many numbers"},
      {given("point = (1, 2, five)" + rest), "file:2: \"five\" is not a number"},
      {given("point = (1, 2, 1e400)" + rest), "file:2: \"1e400\" is not a number"},
      {given("point = (1, 2, nan)" + rest), "file:2: \"nan\" is not a number"},
      {given("point = (1, 2, --5)" + rest), "file:2: \"--5\" is not a number"},
      {given("point = (1, 2, sqrt(1/2/3))" + rest), "file:2: \"1/2/3\" is not a ratio"},
      {given("point = (1, 2, sqrt(5)" + rest),
       "file:2: \"point = (1, 2, sqrt(5)" + rest + "\" has unbalanced parentheses"},
      {given("plane = (0, 0, 2); point = (1, 2, 5); velocity = (0, 0, 1)"),
       "file:2: plane has too few numbers: plane.offset is missing"},
      {given("point = (1, 2, 5); point = (1, 2, 5)" + rest), "file:2: point.x is set twice"},
      {given("point = (1, 2, 5); velocity = (0, 0, 1); plane = (0, 0, 0), 1"),
       "file:2: plane.normal is 0: it must be not all of x, y, z zero"},
      {answer("right  hit_down"), "file:3: an answer is NAME: ANSWER"},
      {answer("right  down: hit; time = 2"), "file:3: the name \"down\" does not begin with a class"},
      {answer("right  hit_down: yes; time = 2"),
       "file:3: an answer to moving_point_plane begins with \"hit\" or \"miss\""},
      {answer("right  hit_down: hit; depth = 2"), "file:3: the query has no number \"depth\""},
      {answer("right  hit_down: hit; normal = (0, 0)"), "file:3: normal has 3 numbers, not 2"},
      {answer("right  hit_down: hit; time = 2; time = 3"), "file:3: time is set twice"},
      {answer(good_answer + good_answer), "file:4: hit_down stands twice"},
  };
  for (const auto& [text, error] : error_of) EXPECT_EQ(errors_of(text), std::vector<std::string>{error}) << text;
  EXPECT_EQ(errors_of(good_classes + good_given + good_answer), std::vector<std::string>{});
}

}  // namespace
}  // namespace nearmiss
