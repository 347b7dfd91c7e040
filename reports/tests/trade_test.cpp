/// Trades: their statistics on data that were computed by hand, and the command on a few cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "corpus/storage/codec.hpp"
#include "impl/subject/subject.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"
#include "reports/trade/errors.hpp"
#include "reports/trade/statistics.hpp"
#include "reports/trade/summary.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;

constexpr double never = std::numeric_limits<double>::infinity();

std::vector<double> up_to(int n) {
  std::vector<double> values;
  for (int i = n; i >= 1; --i) values.push_back(i);
  return values;
}

TEST(TradeStatistics, AQuantileHasItsShareOfTheValuesAtOrBelowIt) {
  std::vector<double> hundred = up_to(100), three{3, 1, 2};
  const auto q = quantiles_of(hundred);
  ASSERT_TRUE(q);
  EXPECT_EQ(q->p50, 50);
  EXPECT_EQ(q->p99, 99);
  EXPECT_EQ(q->max, 100);
  EXPECT_EQ(quantiles_of(three)->p50, 2);
  EXPECT_EQ(quantiles_of(three)->p99, 3);
  std::vector<double> none;
  EXPECT_FALSE(quantiles_of(none));
}

TEST(TradeStatistics, ATailIsKnownOnlyWithEnoughValues) {
  std::vector<double> values = up_to(2000);
  quantiles_of(values);
  EXPECT_EQ(one_in(values, 1000), 1999);
  EXPECT_EQ(one_in(values, 2000), 2000);
  EXPECT_FALSE(one_in(values, 2001));
}

/// The intervals of Clopper and Pearson in tables: 1 of 10 and 5 of 10.
TEST(TradeStatistics, IntervalsOfRatesAreThoseOfTheTables) {
  EXPECT_NEAR(rate_of(1, 10).low, 0.0025, 5e-5);
  EXPECT_NEAR(rate_of(1, 10).high, 0.4450, 5e-5);
  EXPECT_NEAR(rate_of(5, 10).low, 0.1871, 5e-5);
  EXPECT_NEAR(rate_of(5, 10).high, 0.8129, 5e-5);
  EXPECT_EQ(rate_of(0, 0).low, 0);
  EXPECT_EQ(rate_of(0, 0).high, 1);
}

TEST(TradeStatistics, NoneOfManyObeysTheRuleOfThree) {
  const Rate none = rate_of(0, 10'000), all = rate_of(10'000, 10'000);
  EXPECT_EQ(none.low, 0);
  EXPECT_NEAR(none.high, 3e-4, 1e-6);
  EXPECT_NEAR(all.low, 1 - 3e-4, 1e-6);
  EXPECT_EQ(all.high, 1);
}

TEST(TradeStatistics, TheIntervalsOfManyContinueThoseOfFewer) {
  const Rate fewer = rate_of(999, 1'000'000), more = rate_of(1000, 1'000'000);
  // One more of a thousand moves both ends by a thousandth.
  EXPECT_NEAR(more.low / fewer.low, 1.001, 1e-4);
  EXPECT_NEAR(more.high / fewer.high, 1.001, 1e-4);
  EXPECT_LT(more.low, 1e-3);
  EXPECT_GT(more.high, 1e-3);
}

TEST(TradeStatistics, TheFrontHasWhatNothingBeats) {
  const std::vector<Price> choices{{1, 9}, {2, 5}, {3, 5}, {4, 1}, {4, 1}, {5, 2}};
  EXPECT_EQ(pareto_front(choices), (std::vector<bool>{true, true, false, true, true, false}));
}

TEST(TradeStatistics, AProfileComparesEachProblemWithItsLeastCost) {
  PerformanceProfile profile(2);
  profile.add(std::vector<double>{1, 2});
  profile.add(std::vector<double>{3, 1});
  profile.add(std::vector<double>{4, never});
  profile.add(std::vector<double>{never, never});
  EXPECT_EQ(profile.problems(), 4u);
  EXPECT_EQ(profile.share(0, 1), 0.5);
  EXPECT_EQ(profile.share(0, 3), 0.75);
  EXPECT_EQ(profile.share(1, 1), 0.25);
  EXPECT_EQ(profile.share(1, 2), 0.5);
  EXPECT_EQ(profile.solved(0), 0.75);
  EXPECT_EQ(profile.solved(1), 0.5);
}

TEST(TradeStatistics, AProfileWeighsProblems) {
  PerformanceProfile profile(1);
  profile.add(std::vector<double>{1}, 3);
  profile.add(std::vector<double>{never}, 1);
  EXPECT_EQ(profile.share(0, 1), 0.75);
}

TradeTolerance tolerance_in_metres() {
  TradeTolerance t;
  t.unit = "m";
  t.error = 0.25;
  t.missed_depth = 0.5;
  t.time = 0.125;
  return t;
}

TradeAnswer right_answer() {
  TradeAnswer a;
  a.state = TradeAnswer::State::compared;
  a.truth_yes = a.yes = true;
  return a;
}

TradeAnswer missed_by(double depth) {
  TradeAnswer a = right_answer();
  a.yes = false;
  a.missed = true;
  a.shift = depth;
  return a;
}

TEST(TradeErrors, AnAnswerIsBeyondWhereItIsWrongByMoreThanIsTolerable) {
  const TradeTolerance t = tolerance_in_metres();
  TradeAnswer far = right_answer(), late = right_answer(), endless = right_answer(), broke;
  EXPECT_FALSE(is_beyond(far, t));
  far.distance = 0.25;
  EXPECT_FALSE(is_beyond(far, t));
  far.distance = 0.26;
  EXPECT_TRUE(is_beyond(far, t));
  late.time = 0.13;
  EXPECT_TRUE(is_beyond(late, t));
  EXPECT_FALSE(is_beyond(missed_by(0.5), t));
  EXPECT_TRUE(is_beyond(missed_by(0.51), t));
  endless.not_finite = true;
  EXPECT_TRUE(is_beyond(endless, t));
  broke.state = TradeAnswer::State::broke;
  EXPECT_TRUE(is_beyond(broke, t));
}

TEST(TradeErrors, AMissedCornerIsOffByItsDepth) {
  // Far away, all four lower corners are 2^-20 deep.
  const Case c{find_query("box_plane_penetration"),
               Scalar::float64,
               {1000, 0, 1 - 0x1p-20, 1, 1, 1, 0, 0, 0, 1, 0, 0, 1, 0},
               "test",
               0,
               0,
               {}};
  std::vector<double> values{0x1p-20, 0, 0, 1};
  for (int i = 0; i < 8; ++i) {
    const bool is_lower = i < 4;
    const double x = (i & 1) != 0 ? 1001 : 999, y = (i & 2) != 0 ? 1 : -1;
    values.insert(values.end(), {double(is_lower), is_lower ? x : 0, is_lower ? y : 0, is_lower ? -0x1p-20 : 0});
  }
  Answer a;
  a.yes = true;
  std::copy(values.begin(), values.end(), a.values.begin());
  const auto judged = [&] {
    const Finding f = judge(c, a, unbounded_standard(), Detail::full);
    return trade_answer(c, Scalar::float64, a, f, tolerance_in_metres());
  };
  EXPECT_EQ(judged().distance, 0);
  std::fill_n(a.values.begin() + 4, 4, 0.0);
  EXPECT_GT(judged().distance, 0);
  EXPECT_LE(judged().distance, 0x1p-20);
}

TEST(TradeErrors, AWrongFlagHidesNoWrongPlace) {
  // The origin is inside by 2^-20, and the ray goes through the box. The judge proves shifts of up to an eighth.
  const Case c{
      find_query("ray_aabox"), Scalar::float64, {1 - 0x1p-20, 0, 0, -1, 0, 0, -1, -1, -1, 1, 1, 1}, "test", 0, 0, {}};
  Answer a;
  a.yes = true;
  const auto distance_at = [&](double x) {
    for (std::size_t i = 0; i < c.query->outputs.size(); ++i)
      a.values[i] = c.query->outputs[i].name.ends_with("location.x") ? x : 0;
    const Finding f = judge(c, a, unbounded_standard(), Detail::full);
    return trade_answer(c, Scalar::float64, a, f, tolerance_in_metres()).distance;
  };
  EXPECT_LE(distance_at(1), 0x1p-19);
  EXPECT_GE(distance_at(-50), 0.125);
}

TEST(TradeErrors, WithoutAUnitTheBackwardErrorCounts) {
  const TradeTolerance t = relative_tolerance(0.25, "test");
  TradeAnswer a = right_answer();
  a.distance = 100;
  EXPECT_FALSE(is_beyond(a, t));
  a.shift = 0.5;
  EXPECT_TRUE(is_beyond(a, t));
}

const Subject& some_subject() {
  static const Subject s = [] {
    Subject subject;
    subject.name = "some";
    return subject;
  }();
  return s;
}

TradeTimes times_of(const std::vector<double>& of_case) {
  TradeTimes t;
  t.how = TimedHow::typed;
  t.of_case = of_case;
  t.repeats = {of_case.front()};
  t.sequential = {of_case.front()};
  return t;
}

const MetRequirement& requirement(const TradeSummary& s, const std::string& name) {
  for (const MetRequirement& r : s.requirements) {
    if (r.name == name) return r;
  }
  throw std::logic_error("no requirement " + name);
}

TEST(TradeSummary, CountsEachKindOfAnswer) {
  std::vector<TradeAnswer> answers(10, right_answer());
  answers[0] = missed_by(1);
  answers[1] = missed_by(0.25);
  answers[2].state = TradeAnswer::State::broke;
  answers[2].truth_yes = answers[2].yes = false;
  answers[3] = TradeAnswer{};
  TradeTolerance t = tolerance_in_metres();
  t.missed_rate = 0.5;
  const TradeSummary s = summarised(some_subject(), answers, times_of(std::vector<double>(10, 7)), t);
  EXPECT_EQ(s.compared, 8u);
  EXPECT_EQ(s.not_asked, 1u);
  EXPECT_EQ(s.broke.count, 1u);
  EXPECT_EQ(s.broke.of, 9u);
  EXPECT_EQ(s.missed.count, 2u);
  EXPECT_EQ(s.missed.of, 8u);
  EXPECT_EQ(s.missed_deeper.count, 1u);
  EXPECT_EQ(s.beyond.count, 2u);
  EXPECT_EQ(s.missed_depth->max, 1);
  EXPECT_EQ(s.cost(), 7);
  EXPECT_EQ(requirement(s, "cases without an answer").state, MetRequirement::State::failed);
  EXPECT_FALSE(s.meets_all());
}

TEST(TradeSummary, ARateIsShownOnlyByEnoughCases) {
  TradeTolerance t = tolerance_in_metres();
  t.missed_rate = t.phantom_rate = 0.01;
  const auto state_with = [&](std::size_t cases) {
    const std::vector<TradeAnswer> answers(cases, right_answer());
    return requirement(summarised(some_subject(), answers, times_of({1}), t), "missed contacts").state;
  };
  EXPECT_EQ(state_with(200), MetRequirement::State::so_far);  // 3/200 is above the rate
  EXPECT_EQ(state_with(400), MetRequirement::State::shown);
}

TEST(TradeSummary, TheCheapestMeetsEveryRequirement) {
  const TradeTolerance t = tolerance_in_metres();
  std::vector<TradeAnswer> right(20, right_answer()), wrong = right;
  wrong[3].distance = 1;
  wrong[3].shift = 1;
  std::vector<TradeSummary> all{summarised(some_subject(), wrong, times_of({1}), t),
                                summarised(some_subject(), right, times_of({5}), t),
                                summarised(some_subject(), right, times_of({4}), t)};
  EXPECT_EQ(cheapest(all), &all[2]);
  mark_front(all);
  EXPECT_TRUE(all[0].on_front);
  EXPECT_FALSE(all[1].on_front);
  EXPECT_TRUE(all[2].on_front);
  all.resize(1);
  EXPECT_EQ(cheapest(all), nullptr);
}

TEST(TradeStages, AShareOfTheCallsTimesTheirMeanIsTheShareOfTheTime) {
  TradeTimes t = times_of({10, 20, 30, 140, std::numeric_limits<double>::quiet_NaN(), 5});
  t.stage_of_case = {AnswerStage::filter, AnswerStage::filter, AnswerStage::filter,
                     AnswerStage::exact,  AnswerStage::exact,  AnswerStage::unknown};
  const std::vector<StageCost> costs = stage_costs(t);
  ASSERT_EQ(costs.size(), 2u);
  EXPECT_EQ(costs[0].stage, AnswerStage::filter);
  EXPECT_EQ(costs[0].calls.count, 3u);
  EXPECT_EQ(costs[0].calls.of, 4u);
  EXPECT_EQ(costs[0].mean, 20);
  EXPECT_EQ(costs[0].nanoseconds->p50, 20);
  EXPECT_EQ(costs[0].share_of_time, 0.3);
  EXPECT_EQ(costs[1].stage, AnswerStage::exact);
  EXPECT_EQ(costs[1].calls.count, 1u);
  EXPECT_EQ(costs[1].share_of_time, 0.7);
  EXPECT_TRUE(stage_costs(times_of({1, 2})).empty());
}

TEST(TradeStages, TheLastStageOfACallCounts) {
  EXPECT_EQ(last_stage_between({7, 1, 0, 0}, {9, 2, 0, 0}), AnswerStage::extended);
  EXPECT_EQ(last_stage_between({7, 1, 0, 0}, {7, 1, 1, 0}), AnswerStage::exact);
  EXPECT_EQ(last_stage_between({7, 1, 0, 0}, {7, 1, 0, 0}), AnswerStage::unknown);
}

json measured(const TemporaryFolder& folder, std::vector<std::string> more) {
  std::vector<std::string> arguments{"trade", "--query", "sphere_sphere_overlap",  "--cases", "60", "--repeats",
                                     "2",     "--out",   (folder / "out").string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Ran ran = nearmiss(arguments);
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  std::istringstream lines(ran.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
  return json::parse(read_file(folder / "out" / "trade.json"));
}

TEST(TradeCommand, MeasuresEachSubjectOnTheSameCases) {
  const TemporaryFolder folder;
  const json trade = measured(folder, {"-s", "collide-fast-float", "-s", "collide-certified-double"});
  EXPECT_EQ(complaints(trade, "trade.schema.json"), "");
  const json& query = trade["queries"][0];
  EXPECT_EQ(query["cases"], 60);
  ASSERT_EQ(query["subjects"].size(), 2u);
  for (const json& s : query["subjects"]) {
    EXPECT_EQ(s["compared"], 60);
    EXPECT_EQ(s["missed"]["of"], query["contacts"]);
    EXPECT_EQ(s["time"]["how"], "typed calls");
    EXPECT_GT(s["time"]["call"]["p50"], 0);
    EXPECT_GE(s["time"]["call"]["max"], s["time"]["call"]["p99"]);
    EXPECT_GT(s["time"]["calls_per_second"], 0);
  }
  EXPECT_TRUE(query["subjects"][0]["stages"].is_null());
  std::uint64_t in_stages = 0;
  for (const json& stage : query["subjects"][1]["stages"]) in_stages += stage["calls"]["count"].get<std::uint64_t>();
  EXPECT_EQ(in_stages, 60u);
  EXPECT_EQ(query["subjects"][1]["missed"]["count"], 0);
  EXPECT_EQ(query["subjects"][1]["beyond"]["count"], 0);
  EXPECT_EQ(trade["profile"]["problems"], 60);
  const std::string csv = read_file(folder / "out" / "trade.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
}

TEST(TradeCommand, TimesAPluginThroughItsOwnInterface) {
  const TemporaryFolder folder;
  const json trade = measured(folder, {"--plugin", plugin_file("skim_plugin"), "-s", "skim"});
  EXPECT_EQ(complaints(trade, "trade.schema.json"), "");
  EXPECT_EQ(trade["queries"][0]["subjects"][0]["time"]["how"], "calls with decoding");
}

TEST(TradeCommand, TimesAProgramByRoundTrips) {
  const TemporaryFolder folder;
  const json trade = measured(folder, {"--command", example_c(), "-s", "balls-c"});
  EXPECT_EQ(trade["queries"][0]["subjects"][0]["time"]["how"], "round trips through pipes");
}

TEST(TradeCommand, RefusesBadInputInOneLine) {
  for (const std::vector<std::string>& bad : {std::vector<std::string>{"trade", "--cases", "0"},
                                              {"trade", "--tolerance", "-1"},
                                              {"trade", "--query", "no_such_query"},
                                              {"trade", "--repeats", "0"}}) {
    const Ran ran = nearmiss(bad);
    EXPECT_EQ(ran.exit_code, 2) << bad[1];
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  }
}

TEST(TradePage, IsRefusedForAFileThatIsNoTrade) {
  const TemporaryFolder folder;
  folder.file("trade.json", "{\"schema\": 1}");
  const Ran ran = nearmiss({"render", folder.path().string()});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.err.find("trade.json: it is not a trade of schema 1"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace nearmiss
