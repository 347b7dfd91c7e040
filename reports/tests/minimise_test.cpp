/// Minimising and storing: the finding stays the same, the result is simple, and the ranges end where the finding ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "corpus/storage/store.hpp"
#include "impl/subject/provenance.hpp"
#include "reports/engine/replay.hpp"
#include "reports/findings/finding_kind.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"
#include "reports/triage/minimisation/minimise.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// The inputs of sphere_sphere_overlap.
constexpr std::size_t center1_x = 0, radius1 = 3, center2_x = 4, radius2 = 7;

const Subject& honest() {
  static const Subject s = [] {
    for (const Subject& own : own_subjects_in_process()) {
      if (own.name == "collide-certified-float") return own;
    }
    throw std::logic_error("no certified tier");
  }();
  return s;
}

Answer right(std::span<const double> values) { return honest().offering("sphere_sphere_overlap").answer(values); }

/// Answers sphere_sphere_overlap as the certified tier does, but for the cases of a mistake.
Subject mistaken(Answer (*answer)(std::span<const double>)) {
  Subject s = honest();
  s.name = "mistaken";
  std::erase_if(s.offerings, [](const Offering& o) { return o.query != "sphere_sphere_overlap"; });
  s.offerings.at(0).answer = answer;
  return s;
}

Answer blind_above_two_and_a_half(std::span<const double> values) {
  Answer a = right(values);
  if (values[radius1] > 2.5) a.yes = false;
  return a;
}

Answer throws_above_seven(std::span<const double> values) {
  if (values[center2_x] <= 7) return right(values);
  return Answer::without(Answer::Status::broke, "exception: no root in [0, " + std::to_string(values[radius1]) + "]");
}

/// Two balls that overlap, with numbers of many digits.
Case overlapping() {
  return {
      find_query("sphere_sphere_overlap"),
      Scalar::float32,
      {float(0.37), float(-1.41), float(2.23), float(3.7182817), float(1.93), float(0.57), float(-0.77), float(1.7)},
      "test",
      0,
      0,
      {}};
}

std::optional<Minimised> minimised(const Case& question, const Subject& subject, const MinimiseLimits& limits = {}) {
  Workers workers;
  return minimise(question, subject, limits, workers, [](std::uint64_t) {});
}

const SameFinding& range_of(const Minimised& m, std::size_t number) {
  return *std::find_if(m.ranges.begin(), m.ranges.end(), [&](const SameFinding& r) { return r.number == number; });
}

TEST(Minimise, FindsTheSimplestCaseAndTheBordersOfAMistake) {
  const Subject s = mistaken(blind_above_two_and_a_half);
  const auto m = minimised(overlapping(), s);
  ASSERT_TRUE(m.has_value());
  EXPECT_EQ(m->end, Minimised::End::simplest);
  EXPECT_EQ(m->report.finding.disagreement, Disagreement::false_miss);
  EXPECT_EQ(m->report.question.values, (std::vector<double>{0, 0, 0, 4, 0, 0, 0, 0}));
  ASSERT_EQ(m->ranges.size(), 8u);
  const SameFinding& radius = range_of(*m, radius1);
  EXPECT_EQ(radius.low, std::nextafter(2.5f, 3.0f));
  EXPECT_FALSE(radius.to_lowest);
  EXPECT_TRUE(radius.to_highest);
  EXPECT_FALSE(radius.plays_no_part());
  const SameFinding& x = range_of(*m, center1_x);
  EXPECT_EQ(x.low, -4);
  EXPECT_EQ(x.high, 4);
  const SameFinding& other = range_of(*m, radius2);
  EXPECT_TRUE(other.plays_no_part());
  EXPECT_EQ(other.low, 0);
}

TEST(Minimise, KeepsTheKindOfABreakage) {
  const Subject s = mistaken(throws_above_seven);
  Case far = overlapping();
  far.values[center2_x] = float(23.123);
  const auto m = minimised(far, s);
  ASSERT_TRUE(m.has_value());
  EXPECT_EQ(m->report.finding.verdict, Verdict::broke);
  EXPECT_EQ(m->report.question.values[center2_x], 8);
  EXPECT_EQ(range_of(*m, center2_x).low, std::nextafter(7.0f, 8.0f));
  EXPECT_TRUE(range_of(*m, radius1).plays_no_part());
}

/// Numbers near the largest float, which rounding to few bits would leave.
TEST(Minimise, StaysInTheScalar) {
  const Subject s = mistaken(blind_above_two_and_a_half);
  Case huge = overlapping();
  huge.values[center1_x] = huge.values[center2_x] = std::nextafter(largest_finite(Scalar::float32), 0.0f);
  huge.values[radius1] = huge.values[radius2] = std::nextafter(largest_finite(Scalar::float32), 0.0f);
  for (double& x : huge.values) x = float(x);
  for (const std::uint64_t questions : {1, 4, 16, 64}) {
    const auto m = minimised(huge, s, {.questions = questions, .time = std::chrono::seconds(5)});
    ASSERT_TRUE(m.has_value());
    for (const double x : m->report.question.values) EXPECT_TRUE(representable(x, Scalar::float32)) << x;
  }
}

TEST(Minimise, FindsNothingAgainstARightAnswer) {
  const Subject s = mistaken(right);
  EXPECT_FALSE(minimised(overlapping(), s).has_value());
}

TEST(Minimise, StopsAtItsLimitsWithACaseThatHasTheFinding) {
  const Subject s = mistaken(blind_above_two_and_a_half);
  const auto few = minimised(overlapping(), s, {.questions = 3, .time = std::chrono::minutes(10)});
  ASSERT_TRUE(few.has_value());
  EXPECT_EQ(few->end, Minimised::End::questions);
  EXPECT_EQ(few->report.finding.disagreement, Disagreement::false_miss);
  const auto no_time = minimised(overlapping(), s, {.questions = 1000, .time = std::chrono::seconds(0)});
  ASSERT_TRUE(no_time.has_value());
  EXPECT_EQ(no_time->end, Minimised::End::time);
  EXPECT_EQ(no_time->report.question.values, overlapping().values);
  EXPECT_TRUE(no_time->ranges.empty());
  EXPECT_EQ(no_time->ranges_end, Minimised::RangesEnd::time);
  EXPECT_NE(ranges_text(*no_time).find("the time was over"), std::string::npos);
}

/// Triage simplifies cases without asking for ranges: that is no lack of time.
TEST(Minimise, SaysWhereNothingAskedForRanges) {
  const auto m = minimised(overlapping(), mistaken(blind_above_two_and_a_half), {.finds_ranges = false});
  ASSERT_TRUE(m.has_value());
  const std::string text = ranges_text(*m);
  EXPECT_EQ(text.find("time was over"), std::string::npos) << text;
  EXPECT_NE(text.find("The numbers were not moved; 'nearmiss minimise' moves each."), std::string::npos) << text;
  const nlohmann::json j = minimised_to_json(*m);
  EXPECT_EQ(complaints(j, "report.schema.json"), "");
  const Minimised read = minimised_from_json(FileValue(j, "report").at("minimised"), m->report);
  EXPECT_EQ(ranges_text(read), text);
}

TEST(Minimise, IsTheSameEachTimeAndDoneAtOnce) {
  const Subject s = mistaken(blind_above_two_and_a_half);
  const auto once = minimised(overlapping(), s), twice = minimised(overlapping(), s);
  EXPECT_EQ(once->questions, twice->questions);
  const auto again = minimised(once->report.question, s);
  EXPECT_EQ(again->report.question.values, once->report.question.values);
}

TEST(Minimise, WritesAReportThatReplays) {
  const TemporaryFolder folder;
  const std::string plugin = plugin_file("skim_plugin"), out = (folder / "small").string();
  ASSERT_EQ(nearmiss({"run", "--plugin", plugin, "-s", "skim", "-q", "closest_point_segment", "--cases", "2000",
                      "--seed", "1", "--out", (folder / "r").string()})
                .exit_code,
            1);
  const json index = json::parse(read_file(folder / "r" / "index.json"));
  const std::string found = (folder / "r" / index["reports"][0]["file"].get<std::string>()).string();
  const Ran ran = nearmiss({"minimise", "--plugin", plugin, found, "--out", out});
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  for (const char* part : {"Inputs\n", "SUBJECT", "What matters\n", "the lack of a simpler case"}) {
    EXPECT_NE(ran.out.find(part), std::string::npos) << ran.out;
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder / "small" / "closest_point_segment")) files.push_back(entry);
  ASSERT_EQ(files.size(), 1u);
  const json before = json::parse(read_file(found)), after = json::parse(read_file(files[0]));
  EXPECT_EQ(complaints(after, "report.schema.json"), "");
  EXPECT_EQ(after["finding"]["disagreement"], before["finding"]["disagreement"]);
  EXPECT_NE(after["inputs"], before["inputs"]);
  EXPECT_EQ(after["minimised"]["same_finding"].size(), 9u);
  EXPECT_EQ(nearmiss({"replay", "--plugin", plugin, "-s", "skim", files[0].string()}).exit_code, 1);
  const Ran shown = nearmiss({"show", "--plugin", plugin, files[0].string()});
  EXPECT_EQ(shown.exit_code, 1) << shown.err;
  const std::string matters = ran.out.substr(
      ran.out.find("What matters"), ran.out.find("\n\n", ran.out.find("What matters")) - ran.out.find("What matters"));
  EXPECT_NE(shown.out.find(matters), std::string::npos) << shown.out;
  const Ran explained =
      nearmiss({"explain", "--plugin", plugin, files[0].string(), "--out", (folder / "why").string(), "--json"});
  EXPECT_EQ(explained.exit_code, 1) << explained.err;
  EXPECT_EQ(json::parse(explained.out).at(0)["minimised"], after["minimised"]);
  const Ran again = nearmiss({"minimise", "--plugin", plugin, files[0].string(), "--out", out, "--json"});
  EXPECT_EQ(again.exit_code, 1) << again.err;
  EXPECT_EQ(json::parse(again.out).at(0)["inputs"], after["inputs"]);
  const Ran without = nearmiss({"minimise", found, "--out", out});
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_NE(without.err.find("\"skim\", which is no subject here"), std::string::npos) << without.err;
  EXPECT_EQ(std::count(without.err.begin(), without.err.end(), '\n'), 1) << without.err;
}

TEST(Minimise, EndsWithZeroWhereNothingIsFound) {
  const TemporaryFolder folder;
  const Ran ran = nearmiss({"minimise", "-s", "collide-fast-double", "--out", (folder / "r").string(),
                            source_folder() + "/corpus/seeds/sphere_sphere_overlap/apart.json"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(ran.out.find("collide-fast-double has no finding against it"), std::string::npos) << ran.out;
  EXPECT_FALSE(fs::exists(folder / "r"));
}

/// Stores a case in a corpus of its own.
class Promote : public testing::Test {
 protected:
  Ran promote(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "promote");
    return nearmiss(arguments, {"NEARMISS_CORPUS=" + corpus_.path().string()});
  }
  std::string seed(const std::string& name) const {
    return source_folder() + "/corpus/seeds/sphere_sphere_overlap/" + name + ".json";
  }
  /// What is stored under this name, read as tests and nights read it.
  StoredCase stored(const std::string& name) const {
    return read_stored_case(corpus_ / "regressions" / "sphere_sphere_overlap" / (name + ".json"));
  }
  TemporaryFolder corpus_;
};

TEST_F(Promote, StoresTheCaseOfAReportWithItsVerdict) {
  const std::string plugin = plugin_file("skim_plugin");
  const TemporaryFolder runs;
  ASSERT_EQ(nearmiss({"run", "--plugin", plugin, "-s", "skim", "-q", "sphere_sphere_overlap", "--cases", "20000",
                      "--seed", "1", "--out", (runs / "r").string()})
                .exit_code,
            1);
  const json index = json::parse(read_file(runs / "r" / "index.json"));
  const std::string report = (runs / "r" / index["reports"][0]["file"].get<std::string>()).string();
  const std::vector<std::string> arguments{
      report, "--plugin", plugin, "-s", "collide-fast-double", "--note", "A slack of 1e-4 for balls of any size."};
  const Ran ran = promote(arguments);
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  const StoredCase s = stored("apart-skim-false-hit");
  EXPECT_EQ(s.question.values, case_of(json::parse(read_file(report)), report).values);
  EXPECT_EQ(s.note, "A slack of 1e-4 for balls of any size.");
  ASSERT_EQ(s.expected.size(), 2u);
  EXPECT_EQ(s.expected[0].subject, "skim");
  EXPECT_EQ(s.expected[0].verdict, "violates contract");
  EXPECT_EQ(s.expected[0].disagreement, "false hit");
  EXPECT_EQ(s.expected[1].verdict, "agrees");
  const Ran again = promote(arguments);
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.err.find("the case is stored already, in "), std::string::npos) << again.err;
}

TEST_F(Promote, RefusesWrongNames) {
  const std::vector<std::string> more{"-s", "collide-fast-double", "--note", "A note that is long enough."};
  const auto with = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return promote(arguments);
  };
  const Ran yes = with({seed("apart"), "--name", "overlaps"});
  EXPECT_EQ(yes.exit_code, 2);
  EXPECT_NE(yes.err.find("the name overlaps must begin with miss or apart: the exact decision is no"),
            std::string::npos)
      << yes.err;
  EXPECT_NE(with({seed("apart"), "--name", "Apart/.."}).err.find("small letters, digits and hyphens"),
            std::string::npos);
  EXPECT_NE(promote({seed("apart"), "--note", "A note that is long enough."}).err.find("--subject is needed"),
            std::string::npos);
  for (const char* note : {"short", "             ", "a        b   \t c"}) {
    EXPECT_NE(promote({seed("apart"), "--note", note, "-s", "fcl"}).err.find("in a sentence"), std::string::npos)
        << note;
  }
  EXPECT_EQ(with({seed("apart"), "--name", "apart-one"}).exit_code, 0);
  EXPECT_EQ(stored("apart-one").expected.at(0).verdict, "agrees");
}

}  // namespace
}  // namespace nearmiss
