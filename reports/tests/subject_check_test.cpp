/// The check of a new subject: adapters that take one input or answer for another, and what is said about each.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "corpus/files/source_folder.hpp"
#include "reports/tests/mistaken_subject.hpp"
#include "reports/tests/program.hpp"
#include "reports/triage/examination/subject_check.hpp"

namespace nearmiss {
namespace {

using Values = std::span<const double>;

const Query& sphere_box() { return *find_query("moving_sphere_box"); }

Answer right(Values values) { return exact_answer("moving_sphere_box", values); }

CheckedQuery check(Answer (*answer)(Values)) {
  const Subject s = subject_with("moving_sphere_box", answer);
  Workers workers;
  return check_query(sphere_box(), s, workers);
}

std::vector<std::string_view> names_of(const CheckedQuery& c) {
  std::vector<std::string_view> names;
  if (c.misreading) {
    for (const Reading* r : c.misreading->readings) names.push_back(r->name);
  }
  return names;
}

using Names = std::vector<std::string_view>;

std::vector<double> with_halved_extents(Values given) {
  std::vector<double> values(given.begin(), given.end());
  for (const Operand& o : sphere_box().operands) {
    for (std::size_t k = 0; o.half && k < 3; ++k) values[*o.half + k] /= 2;
  }
  return values;
}

Answer with_reversed_normal(Answer a) {
  for (const Layout::Part& p : sphere_box().layout.parts) {
    for (std::size_t i = p.begin; p.role == Role::normal && i < p.end; ++i) a.values[i] = -a.values[i];
  }
  return a;
}

Answer of_full_extents(Values values) { return right(with_halved_extents(values)); }

TEST(SubjectCheck, TellsFullExtentsFromHalfExtents) {
  const CheckedQuery c = check(of_full_extents);
  EXPECT_GT(c.wrong, 10u);
  EXPECT_TRUE(c.is_explained());
  EXPECT_EQ(names_of(c), Names{"half extents halved"});
  const std::string text = checked_text(c, Scalar::float64);
  EXPECT_NE(text.find("right if the given half extents are full extents."), std::string::npos) << text;
  EXPECT_NE(text.find("For example"), std::string::npos) << text;
}

Answer of_a_quaternion_that_begins_with_w(Values given) {
  std::vector<double> values(given.begin(), given.end());
  const std::size_t q = sphere_box().operands.quaternions[0];
  for (std::size_t k = 0; k < 4; ++k) values[q + k] = given[q + (k + 1) % 4];
  return right(values);
}

TEST(SubjectCheck, TellsTheOrderOfAQuaternion) {
  const CheckedQuery c = check(of_a_quaternion_that_begins_with_w);
  EXPECT_TRUE(c.is_explained()) << checked_text(c, Scalar::float64);
  EXPECT_EQ(names_of(c), Names{"quaternion begins with w"});
}

Answer of_distances(Values values) {
  Answer a = right(values);
  const std::size_t v = sphere_box().operands.velocities[0], time = sphere_box().layout.at(Role::time)->begin;
  if (a.yes) a.values[time] *= std::hypot(values[v], values[v + 1], values[v + 2]);
  return a;
}

TEST(SubjectCheck, TellsADistanceFromATime) {
  const CheckedQuery c = check(of_distances);
  EXPECT_TRUE(c.is_explained()) << checked_text(c, Scalar::float64);
  EXPECT_EQ(names_of(c), Names{"distance in place of time"});
}

Answer of_two_meanings(Values values) { return with_reversed_normal(right(with_halved_extents(values))); }

TEST(SubjectCheck, TellsTwoMeaningsTogether) {
  const CheckedQuery c = check(of_two_meanings);
  EXPECT_TRUE(c.is_explained()) << checked_text(c, Scalar::float64);
  const Names names = names_of(c);
  ASSERT_EQ(names.size(), 2u);
  EXPECT_NE(std::find(names.begin(), names.end(), "half extents halved"), names.end());
  EXPECT_NE(std::find(names.begin(), names.end(), "normal reversed"), names.end());
}

Answer always_a_miss(Values) {
  Answer a;
  a.yes = false;
  return a;
}

/// Without sizes, or with the velocity reversed, nearly everything is a miss.
TEST(SubjectCheck, ExplainsNothingByAMeaningThatMissesNearlyEverything) {
  const CheckedQuery c = check(always_a_miss);
  EXPECT_GT(c.wrong, 10u);
  EXPECT_FALSE(c.misreading) << checked_text(c, Scalar::float64);
}

Answer half_of_the_time_wrong(Values values) {
  Answer a = right(values);
  if (std::fmod(std::abs(values[0]) * 64, 2) < 1) a.yes = !a.yes;
  return a;
}

TEST(SubjectCheck, SaysWhatIsUnexplained) {
  const CheckedQuery c = check(half_of_the_time_wrong);
  EXPECT_GT(c.wrong, 10u);
  EXPECT_FALSE(c.is_explained());
  const std::string text = checked_text(c, Scalar::float64);
  EXPECT_TRUE(text.find("No other meaning") != std::string::npos || text.find("Nothing explains") != std::string::npos)
      << text;
}

Answer throws(Values) { throw std::runtime_error("no boxes today"); }

TEST(SubjectCheck, CountsWhatBroke) {
  const CheckedQuery c = check(throws);
  EXPECT_EQ(c.broke, c.asked);
  EXPECT_EQ(c.wrong, 0u);
  EXPECT_FALSE(c.is_fine());
  EXPECT_NE(checked_text(c, Scalar::float64).find("no boxes today"), std::string::npos);
}

/// A file beside impl/program/nearmiss.py, in a folder that other users can read.
std::string program_in(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  std::filesystem::create_directory(folder / "program");
  std::filesystem::copy(source_folder() + "/impl/program/nearmiss.py", folder / "program/nearmiss.py");
  return folder.file("program/" + name, text);
}

/// To start it again for each case would take long.
TEST(SubjectCheck, GivesUpAProgramThatAlwaysBreaks) {
  if (python().empty()) GTEST_SKIP() << "this system has no Python";
  const TemporaryFolder folder;
  const std::string file = program_in(folder, "breaks.py", R"(import nearmiss
def out_of_order(q):
    raise ValueError("out of order")
nearmiss.answer(name="breaks", scalar="double", queries={"sphere_sphere_overlap": out_of_order})
)");
  const std::vector<std::string> words{"check-subject", "--command", python() + " " + file, "-s", "breaks"};
  const Ran ran = nearmiss(words);
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  EXPECT_NE(ran.out.find("0 of 16 cases right, 16 broke the subject; given up, "), std::string::npos) << ran.out;
  std::vector<std::string> for_programs = words;
  for_programs.emplace_back("--json");
  const nlohmann::json j = nlohmann::json::parse(nearmiss(for_programs).out).at("subjects").at("breaks").at(0);
  EXPECT_EQ(j.at("broke"), 16);
  EXPECT_EQ(j.at("wrong"), 0);
  EXPECT_GT(j.at("not_asked"), 40);
}

/// The query behind the one that breaks is right.
TEST(SubjectCheck, BlamesNoQueryForTheOneBefore) {
  if (python().empty()) GTEST_SKIP() << "this system has no Python";
  const TemporaryFolder folder;
  const std::string file = program_in(folder, "slip.py", R"(import math
import nearmiss
def balls_meet(q):
    return math.dist(q.sphere1.center, q.sphere2.center) <= q.sphere1.radius + q.sphere2.radius
def sweep(q):
    return q.other.radius > 0
def point_in_ball(q):
    return math.dist(q.point, q.sphere.center) <= q.sphere.radius
nearmiss.answer(name="slip", scalar="double", queries={
    "point_sphere_overlap": point_in_ball, "moving_sphere_sphere": sweep, "sphere_sphere_overlap": balls_meet})
)");
  const Ran ran = nearmiss({"check-subject", "--json", "--command", python() + " " + file, "-s", "slip"});
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  std::size_t breaking = 0;
  const nlohmann::json queries = nlohmann::json::parse(ran.out).at("subjects").at("slip");
  ASSERT_EQ(queries.size(), 3u);
  EXPECT_NE(queries.back().at("query"), "moving_sphere_sphere") << "no query is asked behind the one that breaks";
  for (const nlohmann::json& q : queries) {
    const bool breaks = q.at("query") == "moving_sphere_sphere";
    breaking += breaks;
    EXPECT_EQ(q.at("broke"), breaks ? 16 : 0) << q;
  }
  EXPECT_EQ(breaking, 1u);
}

/// It answers the first cases: it is asked all.
TEST(SubjectCheck, AsksOnWhereTheFirstCasesAreAnswered) {
  const CheckedQuery c = check([](Values v) -> Answer {
    if (v[0] > 0.5) throw std::runtime_error("out of order");
    return right(v);
  });
  EXPECT_GT(c.broke, 0u);
  EXPECT_EQ(c.not_asked, 0u);
}

TEST(SubjectCheck, FindsNothingInARightSubject) {
  const CheckedQuery c = check(right);
  EXPECT_GT(c.asked, 64u);  // with the seeds
  EXPECT_EQ(c.right, c.asked);
  EXPECT_TRUE(c.is_fine());
  EXPECT_FALSE(c.misreading);
}

TEST(SubjectCheck, IsACommand) {
  const Ran fine = nearmiss({"check-subject", "--subject", "collide-certified-double", "--query", "moving_sphere_box"});
  EXPECT_EQ(fine.exit_code, 0) << fine.err;
  EXPECT_EQ(fine.out, "collide-certified-double: 1 of 1 query answered without a mistake\n");
  const Ran as_json =
      nearmiss({"check-subject", "--json", "--plugin", plugin_file("skim_plugin"), "--subject", "skim"});
  EXPECT_EQ(as_json.exit_code, 1) << as_json.err;
  const nlohmann::json skim = nlohmann::json::parse(as_json.out).at("subjects").at("skim");
  EXPECT_EQ(skim.size(), 3u);
}

}  // namespace
}  // namespace nearmiss
