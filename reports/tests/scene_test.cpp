/// Scenes on the command line: the schema, the command, and runs whose cases are taken from a scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "corpus/files/source_folder.hpp"
#include "corpus/scenes/scene_file.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/subject/subject.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

std::string shipped_scene(const std::string& name) { return (scenes::scenes_folder() / (name + ".json")).string(); }

/// The error of a command that must fail with one line and exit status 2.
std::string refusal_of(const std::vector<std::string>& arguments) {
  const Ran ran = nearmiss(arguments);
  EXPECT_EQ(ran.exit_code, 2) << ran.out;
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  return ran.err;
}

TEST(Scene, EveryShippedSceneFollowsTheSchema) {
  for (const std::string& name : scenes::scene_names())
    EXPECT_EQ(complaints(json::parse(read_file(shipped_scene(name))), "../corpus/scenes/scene.schema.json"), "")
        << name;
  json unsourced = json::parse(read_file(shipped_scene("haptics")));
  unsourced["step"].erase("source");
  EXPECT_NE(complaints(unsourced, "../corpus/scenes/scene.schema.json"), "");
}

TEST(Scene, IsListedShownAndChecked) {
  const Ran list = nearmiss({"scene", "list"});
  EXPECT_EQ(list.exit_code, 0) << list.err;
  for (const std::string& name : scenes::scene_names()) EXPECT_NE(list.out.find(name), std::string::npos);
  const Ran show = nearmiss({"scene", "show", "rendezvous"});
  EXPECT_EQ(show.exit_code, 0) << show.err;
  for (const char* part : {"keep-out (sphere)", "moving_sphere_capsule", "missed depth", "NASA 2005"})
    EXPECT_NE(show.out.find(part), std::string::npos) << part;
  EXPECT_EQ(nearmiss({"scene", "check", shipped_scene("driving")}).exit_code, 0);
}

TEST(Scene, BadInputIsOneLine) {
  TemporaryFolder folder;
  EXPECT_NE(refusal_of({"scene", "show", "moon"}).find("robot-cell"), std::string::npos);
  EXPECT_NE(refusal_of({"scene", "bake"}).find("list, show, check"), std::string::npos);
  EXPECT_NE(refusal_of({"scene", "show"}).find("which scene"), std::string::npos);
  EXPECT_NE(refusal_of({"run", "--scene", "moon"}).find("unknown scene 'moon'"), std::string::npos);
  EXPECT_NE(refusal_of({"run", "--scene", "driving", "-q", "ray_aabox"}).find("box_box_overlap"), std::string::npos);
  json scene = json::parse(read_file(shipped_scene("driving")));
  scene["shapes"][0]["size"]["least"]["value"] = -1;
  const std::string error = refusal_of({"scene", "check", folder.file("negative.json", scene.dump())});
  for (const char* part : {"negative.json", "shapes[0].size.least", "-1", "at least 0"})
    EXPECT_NE(error.find(part), std::string::npos) << error;
  EXPECT_NE(refusal_of({"import", "jsonl", folder.file("a.jsonl", "")}).find("--scene"), std::string::npos);
}

TEST(Scene, NoTierOfCollideViolatesItsContractInAnyScene) {
  TemporaryFolder folder;
  for (const std::string& name : scenes::scene_names()) {
    std::vector<std::string> arguments{"run", "--scene", name, "--cases", "200", "--seed", "4"};
    for (const char* tier : {"fast", "accurate", "decisive", "certified"}) {
      for (const char* scalar : {"float", "double"}) {
        arguments.insert(arguments.end(), {"-s", std::string("collide-") + tier + "-" + scalar});
      }
    }
    arguments.insert(arguments.end(), {"--out", (folder / name).string()});
    const Ran ran = nearmiss(arguments);
    EXPECT_EQ(ran.exit_code, 0) << name << ": " << ran.out << ran.err;
    const scenes::Scene scene = scenes::load_scene(name);
    const json index = json::parse(read_file(folder / name / "index.json"));
    EXPECT_EQ(complaints(index, "run.schema.json"), "");
    EXPECT_EQ(index.at("scene"), name);
    for (const Query* q : scene.all_queries()) EXPECT_NE(ran.out.find(q->name), std::string::npos) << name;
  }
}

TEST(Scene, RelationsHoldInAScene) {
  TemporaryFolder folder;
  const Ran ran = nearmiss({"relations", "--scene", "haptics", "-s", "collide-certified-double", "--cases", "50",
                            "--seed", "1", "--out", (folder / "out").string()});
  EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
}

// Every subject but the tiers of collide is judged by what the scene requires. The balls of this scene are as far from
// the origin, and the tolerances as wide, as in game-world: 0.01 yard, where the usual measure allows 1.7 yards.

std::string scene_of_balls(const TemporaryFolder& folder) {
  json scene = json::parse(read_file(shipped_scene("game-world")));
  scene["name"] = "balls";
  scene["queries"] = json::array({{{"query", "sphere_sphere_penetration"},
                                   {"weight", {{"value", 1}, {"source", "chosen: the query of the test"}}},
                                   {"operands", {{"sphere1", "player"}, {"sphere2", "player"}}}}});
  return folder.file("balls.json", scene.dump());
}

/// The index of a run of the plugin with one mistake.
json run_with(const TemporaryFolder& folder, const std::string& mistake, int exit_code,
              const std::vector<std::string>& also = {}) {
  std::vector<std::string> arguments{"run",
                                     "--plugin",
                                     plugin_file("scenic"),
                                     "-s",
                                     "scenic",
                                     "--cases",
                                     "2000",
                                     "--seed",
                                     "3",
                                     "--out",
                                     (folder / ("run-" + mistake + std::to_string(also.size()))).string()};
  arguments.insert(arguments.end(), also.begin(), also.end());
  if (also.empty()) arguments.insert(arguments.end(), {"--scene", scene_of_balls(folder)});
  const Ran ran = nearmiss(arguments, {"NEARMISS_PLANTED=" + mistake});
  EXPECT_EQ(ran.exit_code, exit_code) << mistake << ran.out << ran.err;
  json index = json::parse(read_file(fs::path(arguments[10]) / "index.json"));
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  if (also.empty()) {
    EXPECT_NE(ran.out.find("the scene balls requires: places and depths within 0.01 yard"), std::string::npos)
        << ran.out;
    EXPECT_EQ(index.at("required").at("position_error"), 0.01);
    EXPECT_EQ(index.at("required").at("unit"), "yard");
    EXPECT_NE(index.at("summary").get<std::string>().find("what the scene balls requires"), std::string::npos);
  } else {
    EXPECT_FALSE(index.contains("required"));
  }
  return index;
}

/// The report of a run that the index lists first.
json first_report(const json& index, const TemporaryFolder& folder, const std::string& mistake) {
  const json report = json::parse(
      read_file(folder / ("run-" + mistake + "0") / index.at("reports").at(0).at("file").get<std::string>()));
  EXPECT_EQ(complaints(report, "report.schema.json"), "");
  return report;
}

TEST(SceneRequirement, DepthErrorsOfAThirdOfAYardDoNotPass) {
  TemporaryFolder folder;
  const json index = run_with(folder, "d", 1), report = first_report(index, folder, "d");
  EXPECT_GT(index.at("findings").get<int>(), 500);
  EXPECT_EQ(report.at("finding").at("disagreement"), "wrong depth");
  EXPECT_EQ(report.at("finding").at("clause"), "the scene balls requires places and depths within 0.01 yard");
  EXPECT_EQ(report.at("measure").at("scene").at("name"), "balls");
  EXPECT_NE(report.at("explanation").get<std::string>().find("The scene balls requires"), std::string::npos);
}

TEST(SceneRequirement, WhatTheSceneToleratesPasses) {
  TemporaryFolder folder;
  EXPECT_EQ(run_with(folder, "n", 0).at("findings"), 0);
  EXPECT_EQ(run_with(folder, "", 0).at("findings"), 0);
}

TEST(SceneRequirement, WrongDecisionsCountByTheirDepthAndGap) {
  TemporaryFolder folder;
  const json missed = first_report(run_with(folder, "m", 1), folder, "m"),
             phantom = first_report(run_with(folder, "p", 1), folder, "p");
  EXPECT_EQ(missed.at("finding").at("disagreement"), "false miss");
  EXPECT_EQ(missed.at("finding").at("clause"), "the scene balls requires missed contacts to be at most 0.01 yard deep");
  EXPECT_EQ(phantom.at("finding").at("disagreement"), "false hit");
  EXPECT_EQ(phantom.at("finding").at("clause"),
            "the scene balls requires phantom contacts to be at most 0.01 yard apart");
}

/// The promise of a library is a share of the coordinates too, and as wide: FCL's times and places of contact.
TEST(SceneRequirement, TakesThePlaceOfThePromisesOfLibraries) {
  if (find_subject("fcl") == nullptr) GTEST_SKIP() << "no FCL in this build";
  TemporaryFolder folder;
  const Ran ran = nearmiss({"run", "--scene", "game-world", "-q", "moving_sphere_box", "-s", "fcl", "-s",
                            "collide-fast-float", "--cases", "300", "--seed", "1", "--out", (folder / "r").string()});
  EXPECT_EQ(ran.exit_code, 1) << ran.out << ran.err;
  const json index = json::parse(read_file(folder / "r" / "index.json"));
  EXPECT_FALSE(index.at("reports").empty());
  for (const json& report : index.at("reports")) {
    EXPECT_EQ(report.at("subject"), "fcl");
    EXPECT_TRUE(report.at("headline").is_string());
  }
}

/// A measure that is asked for replaces it, as it replaces contracts.
TEST(SceneRequirement, GivesWayToAGivenMeasure) {
  TemporaryFolder folder;
  const json by_scene = run_with(folder, "d", 1);
  const json measured = run_with(folder, "d", 1, {"--measure", "1e-4", "--scene", scene_of_balls(folder)});
  EXPECT_GT(by_scene.at("findings").get<int>(), 2 * measured.at("findings").get<int>())
      << "a depth of more than both diameters is wrong by any measure";
}

/// What a run has found, 'replay' and 'triage' find again, and 'relations' judges by the same requirement.
TEST(SceneRequirement, HoldsInEveryCommand) {
  TemporaryFolder folder;
  const std::vector<std::string> planted{"NEARMISS_PLANTED=d"};
  const json index = run_with(folder, "d", 1);
  const fs::path run = folder / "run-d0";
  const std::string report = (run / index.at("reports").at(0).at("file").get<std::string>()).string();
  const Ran again = nearmiss({"replay", "--plugin", plugin_file("scenic"), "-s", "scenic", report}, planted);
  EXPECT_EQ(again.exit_code, 1) << again.out << again.err;
  EXPECT_NE(again.out.find("balls requires places and depths within 0.01 yard"), std::string::npos) << again.out;
  const std::string triaged = (folder / "triage.json").string();
  const Ran triage = nearmiss({"triage", "--plugin", plugin_file("scenic"), run.string(), "--json", triaged}, planted);
  ASSERT_EQ(json::parse(read_file(triaged)).at("signatures").size(), 1) << triage.out << triage.err;
  const json signature = json::parse(read_file(triaged)).at("signatures").at(0);
  EXPECT_EQ(signature.at("clause"), "what the scene requires") << signature;
  const std::vector<std::string> related{"relations",
                                         "--plugin",
                                         plugin_file("scenic"),
                                         "-s",
                                         "scenic",
                                         "--scene",
                                         scene_of_balls(folder),
                                         "--cases",
                                         "200",
                                         "--seed",
                                         "3",
                                         "--out",
                                         (folder / "related").string()};
  const Ran relations = nearmiss(related, planted);
  EXPECT_EQ(relations.exit_code, 1) << relations.out << relations.err;
  EXPECT_NE(relations.out.find("the scene balls requires"), std::string::npos) << relations.out;
  const json all = json::parse(read_file(folder / "related" / "relations.json"));
  EXPECT_EQ(complaints(all, "relations.schema.json"), "");
  EXPECT_EQ(all.at("required").at("name"), "balls");
}

/// A follow-up may be a thousand times larger than the scene's case, and so may its error be.
TEST(SceneRequirement, GrowsWithTheFollowUpsOfARelation) {
  TemporaryFolder folder;
  const Ran ran =
      nearmiss({"relations", "--plugin", plugin_file("scenic"), "-s", "scenic", "--scene", scene_of_balls(folder),
                "--cases", "300", "--seed", "3", "--out", (folder / "out").string()});
  EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
}

/// Imports a file and asks its scene.
void expect_scene_of(const std::string& format, const std::string& file, std::size_t cases, const std::string& query) {
  TemporaryFolder folder;
  const std::string scene = (folder / "mine.json").string();
  const Ran imported = nearmiss({"import", format, file, "--scene", scene, "-s", "collide-certified-double"});
  ASSERT_EQ(imported.exit_code, 0) << imported.out << imported.err;
  EXPECT_EQ(complaints(json::parse(read_file(scene)), "../corpus/scenes/scene.schema.json"), "");
  const scenes::Scene read = scenes::load_scene(scene);
  EXPECT_EQ(read.recorded.size(), cases);
  EXPECT_NE(read.find(*find_query(query)), nullptr);
  const Ran ran = nearmiss({"run", "--scene", scene, "-s", "collide-certified-double", "--cases", "100", "--seed", "1",
                            "--out", (folder / "out").string()});
  EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
  EXPECT_NE(ran.out.find(query), std::string::npos) << ran.out;
}

/// What a program records is what the scene asks: from the recorder's C header to a run.
TEST(Scene, ARecordedTraceBecomesAScene) {
  TemporaryFolder folder;
  const std::string trace = (folder / "trace.jsonl").string();
  ASSERT_EQ(run_program(record_example(), {trace, "3"}).exit_code, 0);
  constexpr std::size_t balls = 4, boxes = 3, steps = 3, pairs = balls * (balls - 1) / 2;
  expect_scene_of("jsonl", trace, steps * (balls * boxes + pairs + balls), "moving_sphere_box");
}

TEST(Scene, ABenchmarkBecomesAScene) {
  constexpr std::size_t fit = 13;
  expect_scene_of("nyu-ccd", source_folder() + "/corpus/nyu-ccd/sample.csv", fit, "moving_point_triangle");
}

TEST(Scene, ATableBecomesAScene) {
  TemporaryFolder folder;
  expect_scene_of("csv",
                  folder.file("trace.csv", "query,scalar,values\nsphere_sphere_overlap,double,0,0,0,1,2,0,0,1\n"), 1,
                  "sphere_sphere_overlap");
}

}  // namespace
}  // namespace nearmiss
