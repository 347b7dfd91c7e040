/// Scenes on the command line: the schema, the command, and runs whose cases are taken from a scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corpus/codec.hpp"
#include "corpus/scenes/scene_file.hpp"
#include "corpus/source_folder.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;

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
