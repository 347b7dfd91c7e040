/// A subject is only asked cases that meet its preconditions, and no other case counts against it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "corpus/generator/fit.hpp"
#include "corpus/storage/codec.hpp"
#include "oracles/requirements.hpp"
#include "reports/engine/relation_report.hpp"
#include "reports/engine/replay.hpp"
#include "reports/engine/run.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;

constexpr std::string_view query = "moving_point_rectangle";
constexpr Preconditions rectangles{Precondition::true_rectangle};

/// Right for true rectangles: the exact decision and no number. Elsewhere it returns the opposite.
Answer right_for_rectangles(std::span<const double> values) {
  const Case c{find_query(query), Scalar::float64, {values.begin(), values.end()}, "", 0, 0, {}};
  Answer a;
  a.given = 0;
  a.yes = exact_decision(c) == meets(c, Precondition::true_rectangle);
  return a;
}
Answer always_wrong(std::span<const double> values) {
  const Case c{find_query(query), Scalar::float64, {values.begin(), values.end()}, "", 0, 0, {}};
  Answer a;
  a.given = 0;
  a.yes = !exact_decision(c);
  return a;
}
/// Breaks on a case that does not meet its preconditions.
Answer breaks_outside(std::span<const double> values) {
  const Answer a = right_for_rectangles(values);
  const Case c{find_query(query), Scalar::float64, {values.begin(), values.end()}, "", 0, 0, {}};
  return meets(c, Precondition::true_rectangle) ? a : Answer::without(Answer::Status::broke, "asked outside");
}

Subject stooge(const char* name, Answer (*answer)(std::span<const double>), Preconditions required) {
  Subject s{.name = name, .version = "1", .scalar = Scalar::float64, .offerings = {}};
  s.offerings.push_back(
      {std::string(query), Offer::answers, "", {.backward = 0, .exact_decisions = true}, answer, required});
  return s;
}

Case case_with(std::array<double, 12> corners) {
  Case c{find_query(query), Scalar::float64, {0.25, 0.25, 1, 0, 0, -1}, "test", 0, 0, {}};
  c.values.insert(c.values.end(), corners.begin(), corners.end());
  return c;
}
Case true_one() { return case_with({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}); }
Case folded_one() { return case_with({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 1}); }

json index_of(const TemporaryFolder& folder, const std::vector<const Subject*>& subjects,
              std::span<const Case> given = {}) {
  Run run({"test", folder / "r", {find_query(query)}, subjects, 1, {}, false});
  if (given.empty()) {
    run.generate(2000);
  } else {
    run.examine(given);
  }
  run.finish();
  return json::parse(read_file(folder / "r" / "index.json"));
}
std::uint64_t verdicts(const json& tally, const char* verdict) {
  return tally.at("verdicts").at(verdict).get<std::uint64_t>();
}

TEST(Requires, NothingOutsideIsAFinding) {
  const TemporaryFolder folder;
  const Subject s = stooge("stooge", breaks_outside, rectangles);
  const std::vector<Case> cases{true_one(), folded_one(), folded_one()};
  const json index = index_of(folder, {&s}, cases);
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  const json& tally = index.at("tallies").at(0);
  EXPECT_EQ(verdicts(tally, "not asked"), 2u);
  EXPECT_EQ(verdicts(tally, "agrees"), 1u);
  EXPECT_EQ(index.at("findings"), 0);
}

/// The same subject without stated preconditions is wrong in most cases of the generator.
TEST(Requires, CasesAreFittedToItAndOthersKeepTheirOwn) {
  const TemporaryFolder folder;
  const Subject says = stooge("says", right_for_rectangles, rectangles);
  const Subject silent = stooge("silent", right_for_rectangles, {});
  const json index = index_of(folder, {&says, &silent});
  const json &with = index.at("tallies").at(0), &without = index.at("tallies").at(1);
  EXPECT_EQ(verdicts(with, "violates contract"), 0u);
  EXPECT_LE(verdicts(with, "not asked"), 2000u / 20);
  EXPECT_EQ(verdicts(with, "not asked") + verdicts(with, "agrees"), 2000u);
  EXPECT_GT(verdicts(without, "violates contract"), 1000u);
  EXPECT_EQ(verdicts(without, "not asked"), 0u);
  const double yes = with.at("yes_share").get<double>();
  EXPECT_GE(yes, 0.1);
  EXPECT_LE(yes, 0.9);
}

TEST(Requires, WhatIsWrongInsideIsAFindingAndItsReportSaysWhatItRequires) {
  const TemporaryFolder folder;
  const Subject s = stooge("stooge", always_wrong, rectangles);
  const std::vector<Case> cases{true_one(), folded_one()};
  const json index = index_of(folder, {&s}, cases);
  EXPECT_EQ(verdicts(index.at("tallies").at(0), "violates contract"), 1u);
  EXPECT_EQ(verdicts(index.at("tallies").at(0), "not asked"), 1u);
  const json report = json::parse(read_file(folder / "r" / index.at("reports").at(0).at("file").get<std::string>()));
  EXPECT_EQ(complaints(report, "report.schema.json"), "");
  EXPECT_EQ(report.at("requires"), json::array({"true rectangle"}));
}

TEST(Requires, AReplayDoesNotAskAndSaysWhy) {
  const Subject s = stooge("stooge", breaks_outside, {Precondition::true_rectangle, Precondition::moves});
  const Subject* asked[] = {&s};
  Workers workers;
  const Replay outside = replay(folded_one(), "file", asked, workers);
  EXPECT_TRUE(outside.reports.empty());
  EXPECT_NE(replay_text(outside).find("not asked: it requires a true rectangle\n"), std::string::npos)
      << replay_text(outside);
  EXPECT_EQ(replay(true_one(), "file", asked, workers).reports.size(), 1u);
  Case both = folded_one();
  both.values[5] = 0;
  EXPECT_NE(replay_text(replay(both, "file", asked, workers))
                .find("it requires a true rectangle and a velocity that is not zero"),
            std::string::npos);
}

/// In a batch where some cases do not meet the preconditions each case gets its own answer.
TEST(Requires, AnswersStayWithTheirCases) {
  const Subject s = stooge("stooge", breaks_outside, rectangles);
  Case beside = true_one();
  beside.values[0] = 9;
  const std::vector<Case> cases{folded_one(), true_one(), folded_one(), beside, true_one()};
  Workers workers;
  for (int again = 0; again < 2; ++again) {
    workers.send(s, cases);
    const auto answers = workers.receive(s);
    ASSERT_EQ(answers.size(), cases.size());
    const std::vector<int> said{-1, 1, -1, 0, 1};
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const bool answered = answers[i].status == Answer::Status::answered;
      EXPECT_EQ(answered ? int(answers[i].yes) : -1, said[i]) << i;
    }
  }
  workers.send(s, std::span(cases).first(1));
  EXPECT_EQ(workers.receive(s).front().reason(), "not asked: it requires a true rectangle");
}

TEST(Requires, RelatedCasesOutsideAreNotCompared) {
  const Subject s = stooge("stooge", always_wrong, rectangles);
  const Relation& moved = *find_relation("translated");
  const Ask ask = [&](const Case& c) { return ask_here(s, c); };
  EXPECT_FALSE(examine(moved, folded_one(), 1, s, ask));
  EXPECT_TRUE(examine(moved, true_one(), 1, s, ask));
}

TEST(Requires, APluginSaysItByBits) {
  const std::string plugin = plugin_file("needs_sizes");
  const Ran listed = nearmiss({"list", "--plugin", plugin, "--json"});
  ASSERT_EQ(listed.exit_code, 0) << listed.err;
  const json list = json::parse(listed.out);
  for (const json& q : list.at("queries")) {
    const bool offered = q.at("query") == "sphere_sphere_overlap";
    EXPECT_EQ(q.at("requires").contains("misbehaves"), offered) << q.at("query");
    if (offered) {
      EXPECT_EQ(q.at("requires").at("misbehaves"), json::array({"no zero sizes"}));
    }
  }
  const Ran why = nearmiss({"list", "--plugin", plugin, "--why"});
  EXPECT_NE(why.out.find("no zero sizes"), std::string::npos);
  const TemporaryFolder folder;  // the plugin aborts where the first number is 1
  write_file(folder / "c.json", R"({"query": "sphere_sphere_overlap", "scalar": "double", "inputs": {"sphere1":
    {"center": [1, 0, 0], "radius": 0}, "sphere2": {"center": [9, 0, 0], "radius": 1}}})");
  const Ran replayed = nearmiss({"replay", "--plugin", plugin, "-s", "misbehaves", (folder / "c.json").string()});
  EXPECT_EQ(replayed.exit_code, 0) << replayed.out << replayed.err;
  EXPECT_NE(replayed.out.find("not asked: it requires no zero sizes"), std::string::npos) << replayed.out;
}

}  // namespace
}  // namespace nearmiss
