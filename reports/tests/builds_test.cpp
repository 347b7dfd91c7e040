/// 'nearmiss builds': builds of one library, compared bit for bit.
#include "reports/builds/builds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "corpus/files/source_folder.hpp"
#include "corpus/search/shrink.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;

constexpr double nan_of_numbers = std::numeric_limits<double>::quiet_NaN();

const Query& query_of(const char* name) { return *find_query(name); }

/// A hit of moving_point_sphere at this time.
Answer hit_at(double time) {
  Answer a;
  a.yes = true;
  a.count = std::uint8_t(query_of("moving_point_sphere").outputs.size());
  a.values[0] = time;
  return a;
}

std::optional<BitDifference> difference_of(const Answer& base, const Answer& other, Scalar s = Scalar::float64) {
  return bit_difference(query_of("moving_point_sphere"), s, base, other);
}

TEST(BitDifference, IsInTheNumberThatDiffersByUnitsInTheLastPlaceOfItsScalar) {
  EXPECT_FALSE(difference_of(hit_at(0.5), hit_at(0.5)));
  const auto one = difference_of(hit_at(0.5), hit_at(0.5 + 0x1p-53));
  ASSERT_TRUE(one);
  EXPECT_EQ(one->kind, BitDifference::Kind::numbers);
  ASSERT_EQ(one->numbers.size(), 1u);
  EXPECT_EQ(one->numbers[0].output, 0u);
  EXPECT_EQ(one->numbers[0].ulps, 1u);
  EXPECT_EQ(difference_of(hit_at(1), hit_at(1 + 0x1p-22), Scalar::float32)->numbers.at(0).ulps, 2u);
}

TEST(BitDifference, TakesAllNaNForTheSameAndTheZerosForDifferent) {
  EXPECT_FALSE(difference_of(hit_at(nan_of_numbers), hit_at(-nan_of_numbers)));
  EXPECT_FALSE(difference_of(hit_at(1), hit_at(nan_of_numbers))->numbers.at(0).ulps);
  const auto zeros = difference_of(hit_at(0), hit_at(-0.0));
  ASSERT_TRUE(zeros);
  EXPECT_EQ(zeros->numbers.at(0).ulps, 0u);
}

/// One word for one thing: what a replay calls not proved is not called wrong.
TEST(Builds, SayNotProvedWhereAReplayDoes) {
  Subject base, other;
  base.name = "old", other.name = "new";
  ComparedBuild c{&query_of("moving_point_sphere"), &base, &other};
  c.first = FirstDifference{};
  c.first->base = {hit_at(1), {}, true};
  Answer miss = hit_at(1);
  miss.yes = false;
  const auto said_of = [&](const Answer& answer, Verdict verdict) {
    Finding f;
    f.verdict = verdict;
    c.first->other = {answer, f, false};
    return right_text(c);
  };
  EXPECT_EQ(said_of(miss, Verdict::violates_contract), "old is right, and new is wrong");
  EXPECT_EQ(said_of(miss, Verdict::exceeds_measure), "old is right, and new is wrong");
  EXPECT_EQ(said_of(miss, Verdict::not_proved),
            "old is right, and new has another decision, not proved to differ by more than is allowed");
  EXPECT_EQ(said_of(Answer::without(Answer::Status::broke, "x"), Verdict::broke),
            "old is right, and new has no answer");
}

TEST(BitDifference, IsNoneInNumbersWithoutAMeaning) {
  Answer miss = hit_at(1), other_miss = hit_at(2);
  miss.yes = other_miss.yes = false;
  EXPECT_FALSE(difference_of(miss, other_miss));
  EXPECT_EQ(difference_of(miss, hit_at(1))->kind, BitDifference::Kind::decision);
  Answer without_time = hit_at(1);
  without_time.given &= ~std::uint64_t{1};
  EXPECT_EQ(difference_of(without_time, hit_at(1))->kind, BitDifference::Kind::given);
  without_time.values[0] = 7;
  Answer also_without = without_time;
  also_without.values[0] = 8;
  EXPECT_FALSE(difference_of(without_time, also_without));
  const Answer cannot = Answer::without(Answer::Status::cannot_answer, "a"),
               cannot_either = Answer::without(Answer::Status::cannot_answer, "b");
  EXPECT_FALSE(difference_of(cannot, cannot_either));
  EXPECT_EQ(difference_of(cannot, hit_at(1))->kind, BitDifference::Kind::status);
}

/// A program in Python that answers sphere_sphere_overlap and moving_point_sphere as balls.py, with one change.
std::string changed_balls(const TemporaryFolder& folder, const std::string& file, const std::string& from,
                          const std::string& to) {
  std::string text = read_file(source_folder() + "/docs/example-program/balls.py");
  const auto replace = [&](const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    if (at == std::string::npos) throw std::runtime_error("balls.py has no " + what);
    text.replace(at, what.size(), by);
  };
  replace("pathlib.Path(__file__).resolve().parent / \"../../impl/program\"",
          "\"" + source_folder() + "/impl/program\"");
  replace(from, to);
  return python() + " " + folder.file(file, text);
}

json printed(const Ran& ran) {
  const json j = json::parse(ran.out);
  EXPECT_EQ(complaints(j, "builds.schema.json"), "");
  return j;
}

class BuildsOfBalls : public testing::Test {
 protected:
  void SetUp() override {
    if (python().empty()) GTEST_SKIP() << "this system has no python3";
    same_ = changed_balls(folder_, "same.py", "def ", "def ");
  }
  Ran compared_with(const std::string& from, const std::string& to, std::vector<std::string> more = {}) {
    std::vector<std::string> words{"builds",
                                   "--command",
                                   same_,
                                   "--command",
                                   changed_balls(folder_, "b.py", from, to),
                                   "--cases",
                                   "500",
                                   "--seed",
                                   "5",
                                   "--out",
                                   (folder_ / "out").string()};
    words.insert(words.end(), more.begin(), more.end());
    return nearmiss(words);
  }

  TemporaryFolder folder_;
  std::string same_;
};

TEST_F(BuildsOfBalls, AreTheSame) {
  const Ran ran = compared_with("def ", "def ");
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(ran.out.find("seed 5: 1,000 pairs of answers in 2 comparisons, none of them different"), std::string::npos)
      << ran.out;
}

TEST_F(BuildsOfBalls, AreComparedWithTheFirstOneThatIsNamed) {
  const Ran ran = compared_with("def ", "def ", {"--json", "balls-py-2", "balls-py"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  const json all = printed(ran).at("comparisons");
  for (const json& c : all) EXPECT_EQ(c.at("base"), "balls-py-2");
}

TEST_F(BuildsOfBalls, DifferInADecisionThatOneHasWrong) {
  const Ran ran = compared_with("<= q.sphere1.radius", "< q.sphere1.radius", {"--json"});
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  const json all = printed(ran).at("comparisons");
  ASSERT_EQ(all.size(), 2u);
  for (const json& c : all) {
    EXPECT_EQ(c.at("base"), "balls-py");
    EXPECT_EQ(c.at("other"), "balls-py-2");
    EXPECT_EQ(c.at("first").is_null(), c.at("query") == "moving_point_sphere") << c;
  }
  const auto overlap =
      std::find_if(all.begin(), all.end(), [](const json& c) { return c.at("query") == "sphere_sphere_overlap"; });
  const json& first = overlap->at("first");
  EXPECT_EQ(first.at("differs_in"), "decision");
  EXPECT_TRUE(first.at("base").at("right"));
  EXPECT_FALSE(first.at("other").at("right"));
  const Case found = case_from_json(first.at("case"), "case");
  EXPECT_LT(simplicity_of(read_case(first.at("file").get<std::string>())), simplicity_of(found));
}

TEST_F(BuildsOfBalls, DifferInANumber) {
  const Ran json_ran = compared_with("c / (math", "1.0000000000000002 * c / (math", {"--json"});
  EXPECT_EQ(json_ran.exit_code, 1) << json_ran.err;
  const json all = printed(json_ran).at("comparisons");
  const auto motion =
      std::find_if(all.begin(), all.end(), [](const json& c) { return c.at("query") == "moving_point_sphere"; });
  const json& first = motion->at("first");
  EXPECT_EQ(first.at("differs_in"), "numbers");
  EXPECT_EQ(first.at("numbers").at(0).at("number"), "time");
  EXPECT_EQ(first.at("numbers").at(0).at("ulps"), 1) << first.at("numbers");
  EXPECT_TRUE(first.at("base").at("right"));
  const Ran text = compared_with("c / (math", "1.0000000000000002 * c / (math");
  EXPECT_NE(text.out.find("balls-py-2 differs from balls-py in "), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("Both are right"), std::string::npos) << text.out;
}

TEST(Builds, RefusesWhatItCannotCompare) {
  struct Refused {
    std::vector<std::string> words;
    std::string why;
  };
  for (const auto& [words, why] : std::vector<Refused>{
           {{"builds"}, "it compares two subjects or more, and none is given"},
           {{"builds", "collide-fast-float"}, "and only collide-fast-float is given"},
           {{"builds", "collide-fast-float", "collide-fast-float"}, "collide-fast-float is named twice"},
           {{"builds", "collide-fast-float", "collide-fast-double"}, "computes in float, and collide-fast-double in"},
           {{"builds", "--collide", "slow"}, "slow"},
           {{"builds", "--collide", "fast", "--command", example_c()}, "--command"},
           {{"builds", "collide-fast-float", "nobody"}, "unknown subject 'nobody'"}}) {
    const Ran ran = nearmiss(words);
    EXPECT_EQ(ran.exit_code, 2) << why;
    EXPECT_NE(ran.err.find(why), std::string::npos) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  }
}

/// What impl/collide/README.md promises of compilers, optimisation and processors, for those that are here.
TEST(Builds, OfCollideHaveTheSameBits) {
  if (is_sanitized) GTEST_SKIP() << "what it compiles is compiled without a sanitizer";
  const TemporaryFolder folder;
  const Ran ran =
      nearmiss({"builds", "--collide", "fast", "--collide", "accurate", "--cases", "2000", "--seed", "11", "--json",
                "--out", (folder / "b").string(), "-q", "sphere_box_overlap", "-q", "moving_point_capsule"});
  ASSERT_LE(ran.exit_code, 1) << ran.err;
  const json said = printed(ran);
  std::size_t builds = 0;
  for (const json& c : said.at("comparisons")) {
    EXPECT_EQ(c.at("asked"), 2000) << c;
    EXPECT_EQ(c.at("different"), c.at("outside")) << c.dump(1);
    builds += c.at("query") == "sphere_box_overlap" && c.at("base") == "collide-fast-float-gcc";
  }
  EXPECT_GE(builds, 4u) << "-O0, -O3 and two for this machine, by one compiler";
}

}  // namespace
}  // namespace nearmiss
