/// Related cases are asked, compared, reported and replayed; a kept promise is never reported as broken.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "corpus/storage/codec.hpp"
#include "reports/engine/relation_report.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string skim = plugin_file("skim_plugin");

json relations_of(const fs::path& folder) { return json::parse(read_file(folder / "relations.json")); }

/// Uses a tolerance that is a length, so that spheres that meet no longer meet when everything is scaled.
TEST(RelationsCommand, FindsTheSlackOfTheExampleAndReplaysIt) {
  const TemporaryFolder folder;
  const Ran ran = nearmiss({"relations", "--plugin", skim, "-s", "skim", "-q", "sphere_sphere_overlap", "-r",
                            "scaled-lengths", "-n", "3000", "--seed", "1", "--out", (folder / "r").string()});
  ASSERT_EQ(ran.exit_code, 1) << ran.out << ran.err;
  const json index = relations_of(folder / "r");
  EXPECT_EQ(complaints(index, "relations.schema.json"), "");
  ASSERT_EQ(index["tallies"].size(), 1u);
  EXPECT_GT(index["tallies"][0]["contract"], 0);
  ASSERT_FALSE(index["reports"].empty());
  for (const json& listed : index["reports"]) {
    const fs::path file = folder / "r" / listed["file"].get<std::string>();
    const json report = json::parse(read_file(file));
    EXPECT_EQ(complaints(report, "report.schema.json"), "") << file;
    EXPECT_EQ(report["headline"], listed["headline"]);
    EXPECT_EQ(report["relation"]["partners"].size(), 1u);
    const Ran again = nearmiss({"replay", "--plugin", skim, "-s", "skim", "--json", file.string()});
    EXPECT_EQ(again.exit_code, listed["breach"] == "contract" ? 1 : 0) << again.err;
    const json replayed = json::parse(again.out);
    ASSERT_EQ(replayed.size(), 1u);
    EXPECT_EQ(complaints(replayed[0], "report.schema.json"), "");
    EXPECT_EQ(replayed[0]["id"], report["id"]);
    EXPECT_EQ(replayed[0]["relation"], report["relation"]);
    const Ran page = nearmiss({"replay", "--plugin", skim, "-s", "skim", file.string()});
    for (const char* part : {"Relation scaled-lengths", "Case 1: ", "Case 2: ", "ANSWER 2", "BREACH"}) {
      EXPECT_NE(page.out.find(part), std::string::npos) << page.out;
    }
  }
}

TEST(RelationsCommand, BreaksNothingOfOurOwnTiers) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments{"relations", "-n", "120", "--seed", "2", "--out", (folder / "r").string()};
  for (const Subject& s : subjects()) {
    if (s.own) arguments.insert(arguments.end(), {"-s", s.name});
  }
  const Ran ran = nearmiss(arguments);
  EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
  std::set<std::string> seen;
  std::uint64_t contradictions_of_the_certified = 0;
  const json index = relations_of(folder / "r");
  for (const json& t : index["tallies"]) {
    seen.insert(t["relation"].get<std::string>());
    EXPECT_EQ(t["bits"].get<int>() + t["contract"].get<int>() + t["broke"].get<int>() + t["oracle"].get<int>(), 0) << t;
    const Subject* s = find_subject(t["subject"].get<std::string>());
    ASSERT_NE(s, nullptr) << t;
    if (promises_every_digit(s->offering(t["query"].get<std::string>()).contract))
      contradictions_of_the_certified += t["contradictions"].get<std::uint64_t>();
  }
  EXPECT_EQ(contradictions_of_the_certified, 0u);
  EXPECT_EQ(seen.size(), relations().size());
}

TEST(RelationsCommand, IsTheSameForTheSameSeed) {
  const TemporaryFolder folder;
  std::vector<json> tallies;
  for (const char* name : {"a", "b"}) {
    const Ran ran = nearmiss(
        {"relations", "-s", "collide-fast-float", "-n", "40", "--seed", "7", "--out", (folder / name).string()});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    tallies.push_back(relations_of(folder / name)["tallies"]);
  }
  EXPECT_EQ(tallies[0], tallies[1]);
}

TEST(RelationsCommand, RefusesAReportWhoseFollowUpsAreOthers) {
  const TemporaryFolder folder;
  ASSERT_EQ(nearmiss({"relations", "--plugin", skim, "-s", "skim", "-q", "sphere_sphere_overlap", "-r",
                      "scaled-lengths", "-n", "3000", "--seed", "1", "--out", (folder / "r").string()})
                .exit_code,
            1);
  json report =
      json::parse(read_file(folder / "r" / relations_of(folder / "r")["reports"][0]["file"].get<std::string>()));
  report["relation"]["partners"][0]["inputs"]["sphere1"]["center"][0] = 0.375;
  const Ran ran = nearmiss({"replay", "--plugin", skim, folder.file("changed.json", report.dump())});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.err.find("changed.json: relation: 'scaled-lengths' does not lead"), std::string::npos) << ran.err;
}

/// A promise above the ladder, which no proof can break.
constexpr collide::Contract lenient{.backward = 0x1p60};

/// Reports an overlap if the first ball has the larger radius: breaks no promise, but contradicts itself.
Subject biased(const collide::Contract& contract) {
  const auto answer = [](std::span<const double> v) {
    Answer a;
    a.yes = v[3] > v[7];
    a.given = 0;
    return a;
  };
  return {.name = "biased",
          .version = "1",
          .scalar = Scalar::float64,
          .offerings = {{"sphere_sphere_overlap", Offer::answers, "", contract, answer}}};
}

RelationReport swapped(const Subject& s) {
  const Case apart{find_query("sphere_sphere_overlap"), Scalar::float64, {0, 0, 0, 2, 9, 0, 0, 1}, "test", 0, 0, {}};
  const RelationFinding f = *examine(*find_relation("swapped"), apart, 0, s,
                                     [&](const Case& c) { return s.offerings.front().answer(c.values); });
  Workers workers;
  return report_of({find_relation("swapped"), 0, false}, f, s, workers);
}

TEST(RelationReport, SaysThatAContradictionBreaksNoPromise) {
  const RelationReport r = swapped(biased(lenient));
  EXPECT_EQ(r.breach, Breach::contradiction);
  EXPECT_FALSE(is_bad(r.breach));
  EXPECT_EQ(headline(r),
            "biased breaks the relation swapped in sphere_sphere_overlap: answer 1 is a false hit, not proved to break "
            "its contract");
  EXPECT_NE(explanation(r).find("Neither answer is proved to break its contract."), std::string::npos)
      << explanation(r);
  const json j = json::parse(report_to_json(r).dump());
  EXPECT_EQ(complaints(j, "report.schema.json"), "");
  EXPECT_EQ(j["relation"]["breaks_contract"], false);
}

Answer says(bool yes) {
  Answer a;
  a.yes = yes, a.given = 0;
  return a;
}

/// Reports the point in no rectangle and in every triangle.
TEST(RelationReport, CountsItsAnswers) {
  const Subject s{
      .name = "triangular",
      .version = "1",
      .scalar = Scalar::float64,
      .offerings = {
          {"point_in_rectangle", Offer::answers, "", lenient, [](std::span<const double>) { return says(false); }},
          {"point_in_triangle", Offer::answers, "", lenient, [](std::span<const double>) { return says(true); }}}};
  const Case inside{find_query("point_in_rectangle"),
                    Scalar::float64,
                    {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0, 0, 0, 1, 3, 1, 0},
                    "test",
                    0,
                    0,
                    {}};
  const RelationFinding f = *examine(*find_relation("two-triangles"), inside, 0, s,
                                     [&](const Case& c) { return s.offering(c.query->name).answer(c.values); });
  Workers workers;
  const RelationReport r = report_of({find_relation("two-triangles"), 0, false}, f, s, workers);
  EXPECT_EQ(r.breach, Breach::contradiction);
  EXPECT_NE(explanation(r).find("None of the 3 answers is proved to break its contract."), std::string::npos)
      << explanation(r);
}

TEST(RelationReport, SaysWhichAnswerBreaksItsContract) {
  const RelationReport r = swapped(biased({.exact_decisions = true}));
  EXPECT_EQ(r.breach, Breach::contract);
  EXPECT_TRUE(is_bad(r.breach));
  EXPECT_NE(explanation(r).find("answer 1: false hit"), std::string::npos) << explanation(r);
  EXPECT_EQ(json::parse(report_to_json(r).dump())["relation"]["breaks_contract"], true);
}

/// Numbers that differ by rounding are no finding, whatever the relation is.
TEST(RelationReport, NumbersAloneProveNothing) {
  const auto answer = [](std::span<const double> v) {
    Answer a;
    a.yes = true;
    a.values[0] = v[0] + 0.25;
    return a;
  };
  const Subject vague{.name = "vague",
                      .version = "1",
                      .scalar = Scalar::float64,
                      .offerings = {{"closest_point_segment", Offer::answers, "", lenient, answer}}};
  const Case c{find_query("closest_point_segment"), Scalar::float64, {0, 0, 0, 4, 0, 0, 1, 2, 0}, "test", 0, 0, {}};
  const RelationFinding f = *examine(*find_relation("turned-corners"), c, 0, vague,
                                     [&](const Case& asked) { return vague.offerings.front().answer(asked.values); });
  EXPECT_EQ(f.agreement, Agreement::numbers_differ);
  EXPECT_EQ(f.breach, Breach::none);
}

}  // namespace
}  // namespace nearmiss
