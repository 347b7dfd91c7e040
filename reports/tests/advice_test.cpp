/// Advice for scenes: the remedies, the files of a profile, and the actions advise and verify on a few cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "corpus/scenes/scene_file.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/advice/profile.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;

/// A scene of Nearmiss that asks one query, and whose time budget no call exceeds.
json scene_of_one_query(const std::string& name, const std::string& query) {
  json scene = json::parse(read_file(scenes::scenes_folder() / (name + ".json")));
  json kept = json::array();
  for (const json& q : scene["queries"]) {
    if (q["query"] == query) kept.push_back(q);
  }
  scene["queries"] = kept;
  scene["queries_per_step"]["value"] = 1;
  scene["step"]["value"] = 1;
  scene["requires"]["time_budget"]["value"] = 1;
  return scene;
}

TradeSource source_of(const json& scene) {
  return scene_cases(std::make_shared<const scenes::Scene>(scenes::scene_from_json(scene, "test.json")));
}

const Remedy& remedy_named(const std::vector<Remedy>& all, const std::string& name) {
  for (const Remedy& r : all) {
    if (r.name == name) return r;
  }
  throw std::logic_error("no remedy " + name);
}

constexpr std::uint64_t drawn_cases = 50;

/// The pairs of a case of the source and the same case of the remedy.
template <class Check>
void for_each_changed_case(const TradeSource& source, const Remedy& remedy, const Query& query, Check check) {
  for (std::uint64_t i = 0; i < drawn_cases; ++i) {
    Case before, after;
    source.draw(before, query, 3, i, {});
    remedy.source.draw(after, query, 3, i, {});
    check(before, after);
  }
}

TEST(Remedies, ReCentredCasesAreTheSameNearTheOrigin) {
  for (const auto& [name, asked] : {std::pair("driving", "box_box_overlap"),
                                    {"driving", "moving_point_triangle"},
                                    {"game-world", "moving_sphere_box"},
                                    {"rendezvous", "moving_sphere_capsule"}}) {
    const TradeSource source = source_of(scene_of_one_query(name, asked));
    const Query& query = *find_query(asked);
    const Remedy remedy = remedy_named(remedies_for(source, query, 1), "re-centre the origin");
    double far = 0, near = 0;
    for_each_changed_case(source, remedy, query, [&](const Case& before, const Case& after) {
      EXPECT_EQ(exact_decision(before), exact_decision(after)) << name;
      far = std::max(far, largest_length(before)), near = std::max(near, largest_length(after));
    });
    EXPECT_LT(near * 8, far) << name;
  }
}

TEST(Remedies, ThePlaneMovesWithTheOrigin) {
  const TradeSource source = source_of(scene_of_one_query("driving", "box_plane_penetration"));
  const Query& query = *find_query("box_plane_penetration");
  const Remedy remedy = remedy_named(remedies_for(source, query, 1), "re-centre the origin");
  const std::size_t plane = query.inputs.size() - 4;  // three numbers of the normal, and the offset
  ASSERT_EQ(query.inputs[plane + 3].role, Role::offset);
  const auto distance = [&](const Case& c) {
    double sum = c.values[plane + 3];
    for (std::size_t k = 0; k < 3; ++k) sum += c.values[plane + k] * c.values[k];
    return sum;
  };
  constexpr double rounding = 8 * 0x1p-53 * 1.1e6;  // of four terms, here and in the remedy; coordinates reach 1.1e6
  for_each_changed_case(source, remedy, query, [&](const Case& before, const Case& after) {
    EXPECT_NEAR(distance(before), distance(after), rounding);
  });
}

TEST(Remedies, AnotherUnitScalesEveryLength) {
  const TradeSource source = source_of(scene_of_one_query("driving", "box_plane_penetration"));
  const Query& query = *find_query("box_plane_penetration");
  const Remedy remedy = remedy_named(remedies_for(source, query, 1), "another unit");
  for_each_changed_case(source, remedy, query, [&](const Case& before, const Case& after) {
    const double factor = source.tolerance.error / remedy.source.tolerance.error;
    EXPECT_NEAR(largest_length(before) / largest_length(after), factor, 1e-12 * factor);
  });
}

TEST(Remedies, ASplitStepStartsWhereTheContactIsNear) {
  const TradeSource source = source_of(scene_of_one_query("driving", "moving_sphere_passes_box"));
  const Query& query = *find_query("moving_sphere_passes_box");
  const Remedy remedy = remedy_named(remedies_for(source, query, 1), "split the step");
  const auto time =
      std::find_if(query.inputs.begin(), query.inputs.end(), [](const Field& f) { return f.role == Role::time; });
  ASSERT_NE(time, query.inputs.end());
  const auto limit = std::size_t(time - query.inputs.begin());
  for_each_changed_case(source, remedy, query,
                        [&](const Case&, const Case& after) { EXPECT_EQ(after.values[limit], 0.125); });
}

TEST(Remedies, ARayHasNoStepToSplit) {
  const TradeSource source = source_of(scene_of_one_query("game-world", "ray_aabox"));
  for (const Remedy& r : remedies_for(source, *find_query("ray_aabox"), 1)) EXPECT_NE(r.name, "split the step");
}

Profile some_profile() {
  return {scenes::load_scene("driving"),
          2,
          10,
          {{find_query("box_box_overlap"), "collide-fast-float", "Evidence."},
           {find_query("moving_sphere_box"), "collide-certified-double", "Evidence."},
           {find_query("box_plane_penetration"), "collide-decisive-double", "Evidence."},
           {find_query("moving_point_triangle"), "bullet", "Evidence."}},
          {{find_query("box_box_penetration"), "nothing meets it"}}};
}

TEST(ProfileHeader, OffersItsQueriesAndSaysWhyOthersAreAbsent) {
  const std::string header = profile_header(some_profile());
  for (const char* part :
       {"#include <collide/box_box_overlap.hpp>", "#include <collide/certified.hpp>", "#include <collide/decisive.hpp>",
        "return collide::box_plane_penetration<collide::Decisive>(arguments...);",
        "return collide::box_box_overlap<collide::Fast>(arguments...);",
        "return collide::moving_sphere_box<collide::Certified>(arguments...);",
        "\"moving_sphere_box: the profile of the scene driving computes in double\"",
        "\"moving_point_triangle is answered by bullet, which is no tier of collide",
        "\"box_box_penetration is not in the profile of the scene driving: nothing meets it\"",
        "\"ray_aabox is not in the profile of the scene driving: add it to the scene and run "
        "'nearmiss scene advise'\""})
    EXPECT_NE(header.find(part), std::string::npos) << part;
  EXPECT_EQ(header.find("#include <collide/ray_aabox.hpp>"), std::string::npos);
  for (const Query& q : catalogue())
    EXPECT_NE(header.find(" " + std::string(q.name) + "(const Arguments&"), std::string::npos) << q.name;
  const std::string cmake = profile_cmake(some_profile());
  EXPECT_NE(cmake.find("COMPONENTS certified"), std::string::npos);
  EXPECT_NE(cmake.find("set(COLLIDE_CERTIFIED_QUERIES moving_sphere_box box_plane_penetration)"), std::string::npos);
}

TEST(ProfileHeader, KnowsTheTiersOfCollide) {
  EXPECT_EQ(tier_of("collide-accurate-double").tier, "Accurate");
  EXPECT_EQ(tier_of("collide-accurate-double").scalar, "double");
  EXPECT_EQ(tier_of("collide-decisive-float").tier, "Decisive");
  EXPECT_EQ(tier_of("bullet").tier, "");
  for (const Subject& s : subjects()) {
    EXPECT_EQ(s.own, !tier_of(s.name).tier.empty()) << s.name;
  }
}

/// Runs the command in a folder with scene.json.
class SceneAdvice : public testing::Test {
 protected:
  Ran advise(const json& scene, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"scene",   "advise", folder_.file("scene.json", scene.dump()), "--out", out(),
                                       "--cases", "100"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Ran ran = nearmiss(arguments);
    std::istringstream lines(ran.out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
    return ran;
  }
  std::string out() const { return (folder_ / "out").string(); }
  json written(const std::string& name) const { return json::parse(read_file(folder_ / "out" / name)); }

  TemporaryFolder folder_;
};

TEST_F(SceneAdvice, FindsATierThatMeetsEverythingAndWritesItsProfile) {
  const Ran ran = advise(scene_of_one_query("haptics", "sphere_triangle_overlap"), {});
  ASSERT_EQ(ran.exit_code, 0) << ran.out << ran.err;
  const json advice = written("advice.json"), profile = written("profile.json");
  EXPECT_EQ(complaints(advice, "advice.schema.json"), "");
  EXPECT_EQ(complaints(profile, "profile.schema.json"), "");
  const json& query = advice["queries"][0];
  EXPECT_EQ(query["candidates"].size(), 8u);
  EXPECT_TRUE(std::ranges::is_sorted(query["candidates"], {}, [](const json& c) {
    return c["nanoseconds"]["sequential"].get<double>();
  })) << query["candidates"];
  const std::string chosen = query["chosen"];
  EXPECT_NE(ran.out.find(chosen), std::string::npos);
  for (const json& c : query["candidates"]) {
    if (c["subject"] != chosen) continue;
    EXPECT_EQ(c["evidence"]["answered"], 100);
    EXPECT_EQ(c["evidence"]["beyond"]["count"], 0);
    EXPECT_LT(c["evidence"]["beyond"]["high"], 3.0 / 100);  // the rule of three bounds 1 - 0.05^(1/100)
  }
  EXPECT_EQ(profile["queries"][0]["subject"], chosen);
  EXPECT_EQ(profile["scene"]["file"], "../scene.json");
}

TEST_F(SceneAdvice, VerifiesAProfileWithFreshCases) {
  ASSERT_EQ(advise(scene_of_one_query("driving", "moving_sphere_box"), {}).exit_code, 0);
  const std::string profile = (folder_ / "out" / "profile.json").string();
  const Ran kept = nearmiss({"scene", "verify", profile, "--cases", "200", "--seed", "7"});
  EXPECT_EQ(kept.exit_code, 0) << kept.out << kept.err;
  EXPECT_NE(kept.out.find("holds"), std::string::npos) << kept.out;
  const Ran stale = nearmiss({"scene", "verify", profile, "--cases", "200", "--seed", "2"});
  EXPECT_EQ(stale.exit_code, 2) << stale.out;
  EXPECT_NE(stale.err.find("not fresh"), std::string::npos) << stale.err;
  json broken = written("profile.json");
  broken["queries"][0]["subject"] = "collide-fast-float";  // the spacing of float is 0.06 m there
  const std::string worse = folder_.file("out/worse.json", broken.dump());
  const Ran failed = nearmiss({"scene", "verify", worse, "--cases", "200", "--seed", "7"});
  EXPECT_EQ(failed.exit_code, 1) << failed.out << failed.err;
  EXPECT_NE(failed.out.find("FAILED"), std::string::npos) << failed.out;
}

TEST_F(SceneAdvice, TriesRemediesWhereNoTierMeetsARequirement) {
  const Ran ran = advise(scene_of_one_query("driving", "moving_sphere_box"), {"-s", "collide-fast-float"});
  EXPECT_EQ(ran.exit_code, 1) << ran.out << ran.err;
  const json advice = written("advice.json"), profile = written("profile.json");
  EXPECT_EQ(complaints(advice, "advice.schema.json"), "");
  EXPECT_EQ(complaints(profile, "profile.schema.json"), "");
  const json& query = advice["queries"][0];
  EXPECT_EQ(query["chosen"], nullptr);
  ASSERT_EQ(query["remedies"].size(), 3u);
  EXPECT_EQ(query["remedies"][0]["name"], "re-centre the origin");
  EXPECT_EQ(query["remedies"][0]["meets_all"], true);
  EXPECT_EQ(query["remedies"][0]["evidence"]["answered"], 100);
  EXPECT_EQ(query["remedies"][2]["meets_all"], false);
  EXPECT_NE(ran.out.find("then meets everything"), std::string::npos) << ran.out;
  EXPECT_EQ(profile["missing"][0]["query"], "moving_sphere_box");
  EXPECT_EQ(nearmiss({"scene", "verify", (folder_ / "out" / "profile.json").string(), "--cases", "10"}).exit_code, 1);
}

/// A step makes calls in sequence, so a subject that takes long in less than half of the cases is dear.
TEST(RankedSubjects, CostWhatACallInSequenceCosts) {
  TradeSummary s;
  s.nanoseconds = Quantiles{10, 1000, 1000};
  const RankedSubject c{&s, std::nullopt, {}};
  EXPECT_FALSE(c.cost().has_value());
  s.sequential = Quantiles{300, 310, 310};
  EXPECT_EQ(c.cost(), 300);
}

/// A profile of two queries of the scene recorded, each with another subject.
std::string some_profile_file(const TemporaryFolder& folder) {
  json profile{{"schema", 1}, {"scene", {{"name", "recorded"}, {"file", nullptr}}}, {"seed", 2}, {"cases", 1}};
  profile["queries"] = json::array({{{"query", "moving_sphere_box"}, {"subject", "collide-fast-float"}},
                                    {{"query", "sphere_sphere_overlap"}, {"subject", "collide-accurate-double"}}});
  profile["missing"] = json::array();
  return folder.file("profile.json", profile.dump());
}

/// The table of a command has each query with its own subject alone.
void expect_pairs_alone(const std::string& said) {
  std::map<std::string, std::set<std::string>> subjects_of;
  std::istringstream lines(said);
  std::string query;
  for (std::string line; std::getline(lines, line);) {
    if (find_query(line) != nullptr) query = line;
    if (line.starts_with("all ")) break;
    if (line.starts_with("  collide-")) subjects_of[query].insert(line.substr(2, line.find(' ', 2) - 2));
  }
  const std::map<std::string, std::set<std::string>> asked{{"moving_sphere_box", {"collide-fast-float"}},
                                                           {"sphere_sphere_overlap", {"collide-accurate-double"}}};
  EXPECT_EQ(subjects_of, asked) << said;
}

TEST(ProfileOption, AsksEachQueryOfItsSubjectAlone) {
  const TemporaryFolder folder;
  const std::string profile = some_profile_file(folder), out = (folder / "out").string();
  const Ran run = nearmiss({"run", "--profile", profile, "--cases", "100", "--seed", "1", "--out", out});
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  expect_pairs_alone(run.out);
  const json index = json::parse(read_file(folder / "out" / "index.json"));
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  EXPECT_EQ(index.at("scene"), "recorded");
  const Ran map = nearmiss({"extremes", "--profile", profile, "--cases", "1", "--out", out});
  EXPECT_EQ(map.exit_code, 0) << map.out << map.err;
  expect_pairs_alone(map.out);
  const json maps = json::parse(read_file(folder / "out" / "extremes.json"));
  EXPECT_EQ(complaints(maps, "extremes.schema.json"), "");
  EXPECT_EQ(maps.at("scene"), "recorded");
  const Ran related = nearmiss({"relations", "--profile", profile, "--cases", "20", "--seed", "1", "--out", out});
  EXPECT_EQ(related.exit_code, 0) << related.out << related.err;
  EXPECT_EQ(related.out.find("collide-certified"), std::string::npos) << related.out;
}

TEST(ProfileOption, ANightAsksNothingElse) {
  const TemporaryFolder folder;
  const Ran night = nearmiss({"nightly", "--profile", some_profile_file(folder), "--minutes",
                              is_sanitized ? "0.4" : "0.05", "--no-triage", "--seed", "1", "--fuzz-targets",
                              folder.path().string(), "--out", (folder / "out").string()});
  EXPECT_EQ(night.exit_code, 0) << night.out << night.err;
  expect_pairs_alone(read_file(folder / "out" / "tables.txt"));
  const json index = json::parse(read_file(folder / "out" / "index.json"));
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  EXPECT_EQ(index.at("scene"), "recorded");
  EXPECT_FALSE(index.contains("properties"));
}

/// The error of a command that must fail with one line and exit status 2.
std::string refused(const std::vector<std::string>& arguments) {
  const Ran ran = nearmiss(arguments);
  EXPECT_EQ(ran.exit_code, 2) << ran.out;
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  return ran.err;
}

TEST_F(SceneAdvice, BadInputIsOneLine) {
  EXPECT_NE(refused({"scene", "advise"}).find("give one scene"), std::string::npos);
  EXPECT_NE(refused({"scene", "advise", "moon"}).find("moon"), std::string::npos);
  EXPECT_NE(refused({"scene", "advise", "driving", "haptics"}).find("give one scene"), std::string::npos);
  EXPECT_NE(refused({"scene", "list", "--cases", "3"}).find("--cases"), std::string::npos);
  EXPECT_NE(refused({"scene", "advise", "robot-cell", "-s", "libccd-gjk", "--cases", "x"}).find("'x'"),
            std::string::npos);
  EXPECT_NE(refused({"scene", "verify", folder_.file("no.json", "{}")}).find("schema"), std::string::npos);
  json profile{{"schema", 1}, {"scene", {{"name", "driving"}, {"file", nullptr}}}, {"seed", 2}, {"cases", 1}};
  profile["queries"] = json::array({{{"query", "moving_sphere_box"}, {"subject", "no-such"}}});
  profile["missing"] = json::array();
  EXPECT_NE(refused({"scene", "verify", folder_.file("a.json", profile.dump())}).find("no subject no-such"),
            std::string::npos);
  EXPECT_NE(refused({"run", "--profile", folder_.file("a.json", profile.dump())}).find("no subject no-such"),
            std::string::npos);
  EXPECT_NE(refused({"run", "--profile", "a.json", "-q", "ray_aabox"}).find("--query"), std::string::npos);
  EXPECT_NE(refused({"run", "--profile", "a.json", "--climb"}).find("--climb"), std::string::npos);
  profile["queries"][0]["query"] = "ray_aabox";
  EXPECT_NE(refused({"scene", "verify", folder_.file("b.json", profile.dump())}).find("does not ask ray_aabox"),
            std::string::npos);
  profile.erase("queries");
  EXPECT_NE(refused({"scene", "verify", folder_.file("c.json", profile.dump())}).find("queries"), std::string::npos);
}

}  // namespace
}  // namespace nearmiss
