/// A climb finds what random sampling does not, keeps its records, and repeats itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "corpus/generator/generator.hpp"
#include "corpus/search/float_order.hpp"
#include "corpus/search/neighbours.hpp"
#include "corpus/storage/codec.hpp"
#include "oracles/requirements.hpp"
#include "reports/engine/climb.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Ask = std::function<Answer(const Case&)>;

const Query& query() { return *find_query("sphere_sphere_penetration"); }

/// A subject that promises nothing. Only its name, its scalar and its offer matter: the tests give the answers.
const Subject& tested() {
  static const Subject s{.name = "tested",
                         .version = "1",
                         .scalar = Scalar::float64,
                         .offerings = {{std::string(query().name), Offer::answers, "", {}, [](std::span<const double>) {
                                          return Answer{};
                                        }}}};
  return s;
}

Climb climb_of(std::uint64_t seed, Climb::Source source = Climb::Source::neighbours) {
  return Climb({&query(), &tested(), ErrorKind::forward, seed, source});
}

/// Within two ulps; the other tiers have large forward errors of their own.
Answer right(const Case& c) { return ask_here(*find_subject("collide-certified-double"), c); }

/// The right answer, with a depth that is off by so many ulps.
Answer off_by(const Case& c, double ulps) {
  constexpr std::size_t depth = 0;
  Answer a = right(c);
  a.values[depth] += std::floor(ulps) * ulp(a.values[depth], Scalar::float64);
  return a;
}

/// Answers at most `answered` cases of a round. Calls `seen` with each finding.
void round(Climb& climb, const Ask& ask, std::size_t answered = 1u << 20,
           const std::function<void(const Finding&)>& seen = {}) {
  const std::span<const Case> cases = climb.propose(1u << 20);
  for (std::size_t i = 0; i < std::min(cases.size(), answered); ++i) {
    const Answer a = ask(cases[i]);
    const Finding f = judge(cases[i], a, tested().standard_for(query().name), Climb::detail);
    if (seen) seen(f);
    climb.take(i, a, f);
  }
  climb.end_round();
}

double error_so_far(const Climb& c) { return c.record() ? c.record()->error : 0; }

class Climbs : public testing::Test {
 protected:
  void SetUp() override {
    if (find_subject("collide-certified-double") == nullptr) GTEST_SKIP() << "the build lacks the certified tier";
  }
};

/// An error of 2^20 ulps at one place, which no generator knows, and less with the distance from it.
constexpr double peak = 0x1p20;
Answer with_peak(const Case& c) {
  const double x = c.values[0] - 3.2171908, z = c.values[6] + 1.1379103;
  return off_by(c, peak / (1 + 64 * std::hypot(x, z)));
}

TEST_F(Climbs, FindsAPeakThatSamplingDoesNot) {
  constexpr std::uint64_t cases = 12'000;
  constexpr double near_peak = 0.99 * peak;
  Climb climb = climb_of(1), sampling = climb_of(1, Climb::Source::generator);
  while (climb.asked() < cases) round(climb, with_peak);
  while (sampling.asked() < cases) round(sampling, with_peak);
  EXPECT_GT(error_so_far(climb), near_peak);
  EXPECT_LT(error_so_far(sampling), near_peak);
  EXPECT_GT(error_so_far(sampling), 0);
  EXPECT_EQ(sampling.hills(), 0u);
  EXPECT_TRUE(climb.record()->question.origin.starts_with("climb from generator"));
}

/// The formula of a library divides by |d|^2 - b r1 r2, and loses digits where that is nearly zero. Where almost
/// nothing is left of it, the library calls the balls apart. No lattice meets the constant b.
Answer with_degeneracy(const Case& c, double& divisor) {
  double distance2 = 0;
  for (std::size_t k = 0; k < 3; ++k) distance2 += (c.values[k] - c.values[4 + k]) * (c.values[k] - c.values[4 + k]);
  constexpr double b = 2.718281828;
  const double product = b * c.values[3] * c.values[7];
  divisor = product > 0 ? std::abs(distance2 - product) / product : 1;
  if (!(divisor > 0 && divisor <= 1)) return right(c);  // another formula
  constexpr double fatal = 0x1p-34;
  if (divisor > fatal) return off_by(c, 1 / divisor);
  Answer apart = right(c);
  apart.yes = false;
  return apart;
}

TEST_F(Climbs, FindsABugNearADegeneracyThatSamplingDoesNot) {
  constexpr std::uint64_t cases = 12'000;
  for (const Climb::Source source : {Climb::Source::neighbours, Climb::Source::generator}) {
    Climb climb = climb_of(3, source);
    std::uint64_t misses = 0;
    double divisor = 0;
    while (climb.asked() < cases && misses == 0) {
      round(
          climb, [&](const Case& c) { return with_degeneracy(c, divisor); }, 1u << 20,
          [&](const Finding& f) { misses += f.has(Disagreement::false_miss); });
    }
    EXPECT_EQ(misses > 0, source == Climb::Source::neighbours) << misses << " found";
  }
}

TEST_F(Climbs, KeepsItsRecord) {
  Climb climb = climb_of(2);
  double before = 0;
  for (int i = 0; i < 60; ++i) {
    round(climb, with_peak);
    EXPECT_GE(error_so_far(climb), before);
    before = error_so_far(climb);
  }
  ASSERT_TRUE(climb.record());
  const Case& c = climb.record()->question;
  EXPECT_EQ(error_of(c, with_peak(c), tested().standard_for(query().name), ErrorKind::forward), before);
}

TEST_F(Climbs, IsTheSameForTheSameSeed) {
  Climb a = climb_of(4), b = climb_of(4), other = climb_of(5);
  bool differs = false;
  for (int i = 0; i < 40; ++i) {
    round(a, with_peak);
    round(b, with_peak);
    round(other, with_peak);
    const std::span<const Case> now = a.propose(64), same = b.propose(64), another = other.propose(64);
    ASSERT_EQ(now.size(), same.size());
    for (std::size_t k = 0; k < now.size(); ++k) ASSERT_EQ(now[k].values, same[k].values) << "round " << i;
    differs = differs || another.size() != now.size() || another[0].values != now[0].values;
  }
  EXPECT_TRUE(differs);
}

/// Above half of the peak the subject has no comparable answer.
TEST_F(Climbs, TakesNoStepToACaseWithoutAComparableAnswer) {
  for (const Answer::Status status : {Answer::Status::broke, Answer::Status::cannot_answer}) {
    Climb climb = climb_of(6);
    const auto ask = [&](const Case& c) {
      const Answer a = with_peak(c);
      const double ulps = std::abs(a.values[0] - right(c).values[0]) / ulp(a.values[0], Scalar::float64);
      return ulps > peak / 2 ? Answer::without(status, "too high") : a;
    };
    while (climb.asked() < 6'000) round(climb, ask);
    EXPECT_LE(error_so_far(climb), peak / 2 + 1);
    EXPECT_GT(error_so_far(climb), peak / 4);
  }
}

TEST_F(Climbs, LosesNothingWhenARoundIsInterrupted) {
  Climb climb = climb_of(7);
  double before = 0;
  for (std::size_t i = 0; i < 40; ++i) {
    round(climb, with_peak, 1 + i % 16);
    EXPECT_GE(error_so_far(climb), before);
    before = error_so_far(climb);
    ASSERT_FALSE(climb.is_over());
  }
  EXPECT_GT(before, 0);
  round(climb, with_peak, 0);
  EXPECT_TRUE(climb.is_over());
  EXPECT_EQ(error_so_far(climb), before);
}

TEST_F(Climbs, BeginsAtTheStoredCaseAndMeasuresItAgain) {
  Climb first = climb_of(8);
  for (int i = 0; i < 20; ++i) round(first, with_peak);
  WorstCase stored = *first.record();
  Climb::Settings settings{&query(), &tested(), ErrorKind::forward, 9};
  stored.error *= 2;  // as if the subject had become better since
  settings.stored = stored;
  Climb next(settings);
  EXPECT_FALSE(next.stored_now());
  round(next, with_peak);
  EXPECT_EQ(next.stored_now(), first.record()->error);
  EXPECT_EQ(error_so_far(next), first.record()->error);
}

TEST(Neighbours, AreValidExactAndDifferent) {
  for (const Query& q : catalogue()) {
    for (const Scalar scalar : {Scalar::float32, Scalar::float64}) {
      int different = 0;
      for (std::uint64_t i = 0; i < 200; ++i) {
        const Case c = generate(q, scalar, 11, i), n = neighbour(c, 1 + int(i % 3), i);
        different += n.values != c.values;
        EXPECT_FALSE(q.broken(n.values)) << q.name;
        for (const double x : n.values) ASSERT_TRUE(std::isfinite(x) && representable(x, scalar)) << q.name;
        EXPECT_EQ(neighbour(c, 1 + int(i % 3), i).values, n.values);
      }
      EXPECT_GT(different, 150) << q.name;
    }
  }
}

TEST(Neighbours, MoveByUlps) {
  const double least = 0x1p-1074, most = 0x1.fffffffffffffp1023;
  EXPECT_EQ(moved_by_ulps(1, 1, Scalar::float64), std::nextafter(1.0, 2.0));
  EXPECT_EQ(moved_by_ulps(1, -1, Scalar::float64), std::nextafter(1.0, 0.0));
  EXPECT_EQ(moved_by_ulps(1, 1, Scalar::float32), double(std::nextafter(1.0f, 2.0f)));
  EXPECT_EQ(moved_by_ulps(-1, 1, Scalar::float64), std::nextafter(-1.0, 0.0));
  EXPECT_EQ(moved_by_ulps(least, -2, Scalar::float64), -least);
  EXPECT_EQ(moved_by_ulps(-0.0, 1, Scalar::float64), least);
  EXPECT_EQ(moved_by_ulps(most, std::int64_t{1} << 52, Scalar::float64), most);
  EXPECT_EQ(moved_by_ulps(-most, -(std::int64_t{1} << 52), Scalar::float64), -most);
}

/// `nearmiss run --climb` of one pair into `out`, with the worst cases of the folder `corpus`.
Ran run_climb(const fs::path& corpus, const fs::path& out, std::vector<std::string> more) {
  std::vector<std::string> arguments{
      "run", "--climb", "-s", "collide-fast-float", "-q", "sphere_sphere_penetration", "--out", out.string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return nearmiss(arguments, {"NEARMISS_CORPUS=" + corpus.string()});
}

json index_of_climb(const fs::path& out) { return json::parse(read_file(out / "index.json")); }

TEST(RunClimb, WritesAValidIndexAndTheWorstCases) {
  const TemporaryFolder folder;
  std::vector<json> climbs;
  for (const char* name : {"a", "b"}) {
    const Ran ran = run_climb(folder.path(), folder / name, {"--cases", "3000", "--seed", "1"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err << ran.out;
    EXPECT_NE(ran.out.find("BACKWARD ERROR, EPSILON"), std::string::npos) << ran.out;
    const json index = index_of_climb(folder / name);
    EXPECT_EQ(complaints(index, "run.schema.json"), "");
    EXPECT_EQ(index["tallies"][0]["cases"], 6000) << "3000 for each kind of error";
    EXPECT_EQ(index["touches"], json::array()) << "a search is no sample";
    climbs.push_back(index["climbs"]);
  }
  EXPECT_EQ(climbs[0], climbs[1]) << "the same for the same seed";
  ASSERT_EQ(climbs[0].size(), 2u);
  for (const json& c : climbs[0]) {
    const WorstCase w = read_worst_case(
        folder / ("a/worst/sphere_sphere_penetration/collide-fast-float-" + c["kind"].get<std::string>() + ".json"));
    EXPECT_EQ(c["error"], w.error);
    const Subject& s = *find_subject("collide-fast-float");
    EXPECT_EQ(error_of(w.question, ask_here(s, w.question), s.standard_for(query().name), w.kind), w.error);
  }
}

TEST(RunClimb, StoresWorseCasesOnly) {
  const TemporaryFolder folder;
  const fs::path file = folder / "worst/sphere_sphere_penetration/collide-fast-float-backward.json";
  const auto update = [&](const char* seed, const char* cases) {
    const Ran ran = run_climb(folder.path(), folder / "r", {"--update-worst", "--cases", cases, "--seed", seed});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return ran.out;
  };
  EXPECT_NE(update("1", "4000").find("epsilon, new"), std::string::npos);
  WorstCase stored = read_worst_case(file);
  for (const char* seed : {"2", "3"}) {
    update(seed, "300");
    const double now = read_worst_case(file).error;
    EXPECT_GE(now, stored.error);
  }
  stored = read_worst_case(file);
  const double measured = stored.error;
  stored.error = 100;  // as if the tier had become better since
  write_file(file, worst_case_to_json(stored).dump());
  EXPECT_NE(update("4", "300").find("before 100, which today is "), std::string::npos);
  EXPECT_GE(read_worst_case(file).error, measured);
  EXPECT_LT(read_worst_case(file).error, 100);
}

TEST(RunClimb, StoresAnEqualErrorWhereTheStoredCaseHasItNoLonger) {
  const TemporaryFolder folder;
  const fs::path file = folder / "worst/sphere_sphere_penetration/collide-fast-float-backward.json";
  const auto update = [&] {
    const Ran ran = run_climb(folder.path(), folder / "r", {"--update-worst", "--cases", "4000", "--seed", "1"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return ran.out;
  };
  update();
  WorstCase stored = read_worst_case(file);
  stored.question.values = {0, 0, 0, 1, 1, 0, 0, 1};  // without an error
  // The only stored case, so that both updates below climb from the same cases.
  const auto store = [&](double error) {
    stored.error = error;
    fs::remove(folder / "worst/sphere_sphere_penetration/collide-fast-float-forward.json");
    write_file(file, worst_case_to_json(stored).dump());
  };
  store(100);
  update();
  const double found = read_worst_case(file).error;
  store(found);
  EXPECT_NE(update().find("which today is 0"), std::string::npos);
  const WorstCase now = read_worst_case(file);
  const Subject& s = *find_subject("collide-fast-float");
  EXPECT_EQ(now.error, found);
  EXPECT_EQ(error_of(now.question, ask_here(s, now.question), s.standard_for(query().name), now.kind), found);
}

TEST(RunClimb, StoresWhatItFoundWhenInterrupted) {
  const TemporaryFolder folder;
  const std::string out = (folder / "r").string();
  const std::string script =
      "NEARMISS_CORPUS='" + folder.path().string() + "' '" + nearmiss_program() +
      "' run --climb --update-worst -s collide-fast-float -q sphere_sphere_penetration "
      "--seconds 100 --out '" +
      out + "' & run=$!; while [ ! -e '" + out +
      "/worst/sphere_sphere_penetration/collide-fast-float-forward.json' ]; do sleep 0.05; done; "
      "kill -TERM $run; wait $run";
  const Ran ran = run_program("bash", {"-c", script});
  EXPECT_EQ(ran.exit_code, 2) << ran.out << ran.err;
  EXPECT_EQ(index_of_climb(out)["state"], "interrupted");
  const char* below = "worst/sphere_sphere_penetration/collide-fast-float-forward.json";
  EXPECT_EQ(read_worst_case(folder / below).error, read_worst_case(folder / "r" / below).error);
}

TEST(RunClimb, RefusesWhatDoesNotFitInOneLine) {
  const std::vector<std::vector<std::string>> bad{{"run", "--update-worst"},
                                                  {"run", "--climb", "--update-worst", "--measure", "1e-5"},
                                                  {"run", "--climb=3"},
                                                  {"run", "--climb", "--seconds", "1", "--cases", "5"}};
  for (const auto& arguments : bad) {
    const Ran ran = nearmiss(arguments);
    EXPECT_EQ(ran.exit_code, 2) << ran.out;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_TRUE(ran.err.starts_with("nearmiss: ")) << ran.err;
  }
}

TEST(Run, AsksTheStoredWorstCasesFirst) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_climb(folder.path(), folder / "r", {"--update-worst", "--cases", "2000", "--seed", "1"}).exit_code, 0);
  const auto cases = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"run",
                                       "-s",
                                       "collide-fast-float",
                                       "-s",
                                       "collide-fast-double",
                                       "-q",
                                       "sphere_sphere_penetration",
                                       "--seed",
                                       "1",
                                       "-n",
                                       "10",
                                       "--out",
                                       (folder / "s").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_NE(nearmiss(arguments, {"NEARMISS_CORPUS=" + folder.path().string()}).exit_code, 2);
    const json tallies = index_of_climb(folder / "s")["tallies"];
    return std::vector<int>{tallies[0]["cases"], tallies[1]["cases"]};
  };
  const std::vector<int> asked = cases({});
  EXPECT_EQ(*std::max_element(asked.begin(), asked.end()), 12) << "a forward and a backward error";
  EXPECT_EQ(*std::min_element(asked.begin(), asked.end()), 10) << "of one subject";
  EXPECT_EQ(cases({"--measure", "1e-3"}), (std::vector<int>{10, 10}));
  const fs::path file = folder / "worst/sphere_sphere_penetration/collide-fast-float-forward.json";
  fs::rename(file, folder / "worst/sphere_sphere_penetration/collide-fast-double-forward.json");
  const Ran ran =
      nearmiss({"run", "-n", "1", "--out", (folder / "t").string()}, {"NEARMISS_CORPUS=" + folder.path().string()});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.err.find("must be named after its query, subject and kind"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace nearmiss
