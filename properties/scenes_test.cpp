/// Scenes: their files are read with every rule, every number has a source, and their cases are those of their world.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "corpus/scenes/operands.hpp"
#include "corpus/scenes/recorded_cases.hpp"
#include "corpus/scenes/scene_cases.hpp"
#include "corpus/scenes/solids.hpp"
#include "corpus/storage/codec.hpp"
#include "oracles/exact/oracle.hpp"

namespace nearmiss::scenes {
namespace {

using nlohmann::json;

json json_of_scene(const std::string& name) { return json::parse(read_file(scenes_folder() / (name + ".json"))); }

/// A change of a valid scene, and parts of the error that it must cause.
struct BrokenScene {
  const char* what;
  const char* patch;  ///< JSON Patch
  std::vector<std::string> says;
};

const BrokenScene broken_scenes[] = {
    {"unit", R"([{"op": "replace", "path": "/unit", "value": "parsec"}])", {"unit is \"parsec\"", "yard, metre"}},
    {"size",
     R"([{"op": "replace", "path": "/shapes/0/size/value", "value": -0.5}])",
     {"shapes[0].size is -0.5", "at least 0"}},
    {"order",
     R"([{"op": "replace", "path": "/shapes/0/speed/most/value", "value": 1}])",
     {"shapes[0].speed.most is 1", "at least shapes[0].speed.least, 2.5"}},
    {"logarithm",
     R"([{"op": "replace", "path": "/shapes/2/size/least/value", "value": 0}])",
     {"shapes[2].size.least is 0", "logarithmic"}},
    {"source", R"([{"op": "remove", "path": "/step/source"}])", {"step.source is missing"}},
    {"empty_source",
     R"([{"op": "replace", "path": "/step/source", "value": ""}])",
     {"step.source is \"\"", "not empty"}},
    {"no_number",
     R"([{"op": "replace", "path": "/step/value", "value": "fast"}])",
     {"step is \"fast\"", "a number above 0"}},
    {"impossible",
     R"([{"op": "replace", "path": "/requires/position_error/value", "value": 1e-13}])",
     {"requires.position_error is 1e-13", "the spacing of doubles"}},
    {"depth",
     R"([{"op": "replace", "path": "/requires/missed_depth/value", "value": 0}])",
     {"requires.missed_depth is 0", "above 0"}},
    {"rate",
     R"([{"op": "replace", "path": "/requires/missed_rate/value", "value": 1.5}])",
     {"requires.missed_rate is 1.5", "at most 1"}},
    {"budget",
     R"([{"op": "replace", "path": "/requires/time_budget/value", "value": 1}])",
     {"requires.time_budget is 1", "at most 0.015625"}},
    {"query",
     R"([{"op": "replace", "path": "/queries/0/query", "value": "sphere_moon"}])",
     {"queries[0].query is \"sphere_moon\"", "list"}},
    {"twice",
     R"([{"op": "replace", "path": "/queries/0/query", "value": "moving_sphere_box"},
                  {"op": "replace", "path": "/queries/0/operands", "value": {"sphere": "player", "box": "building"}}])",
     {"queries[1].query is \"moving_sphere_box\"", "once"}},
    {"not_of_shapes",
     R"([{"op": "replace", "path": "/queries/0/query", "value": "bounce_direction"}])",
     {"queries[0].query is \"bounce_direction\"", "two shapes"}},
    {"operand",
     R"([{"op": "replace", "path": "/queries/0/operands/sphere", "value": "building"}])",
     {"queries[0].operands.sphere is \"building\"", "sphere", "box"}},
    {"no_such_shapes",
     R"([{"op": "replace", "path": "/queries/0/operands/sphere", "value": "dragon"}])",
     {"\"dragon\"", "the name of shapes"}},
    {"at_rest", R"([{"op": "remove", "path": "/shapes/0/speed"}])", {"operands.sphere is \"player\"", "speed"}},
    {"type",
     R"([{"op": "replace", "path": "/shapes/0/type", "value": "blob"}])",
     {"shapes[0].type is \"blob\"", "sphere"}},
    {"unknown", R"([{"op": "add", "path": "/weather", "value": "rain"}])", {"weather is unknown"}},
    {"scalar", R"([{"op": "replace", "path": "/scalar/value", "value": "half"}])", {"scalar is \"half\"", "float"}},
    {"share", R"([{"op": "replace", "path": "/near_contact/value", "value": 2}])", {"near_contact is 2", "at most 1"}},
    {"both", R"([{"op": "add", "path": "/cases", "value": "a.jsonl"}])", {"shapes and cases"}},
    {"name", R"([{"op": "replace", "path": "/name", "value": "Game World"}])", {"name is \"Game World\""}},
};

TEST(Scenes, AFileThatBreaksARuleStatesFileFieldValueAndRule) {
  const json valid = json_of_scene("game-world");
  for (const BrokenScene& b : broken_scenes) {
    const json j = valid.patch(json::parse(b.patch));
    try {
      scene_from_json(j, "world.json");
      ADD_FAILURE() << b.what << ": no error";
    } catch (const BadInput& e) {
      const std::string text = e.what();
      EXPECT_TRUE(text.starts_with("world.json: ")) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
      for (const std::string& part : b.says) EXPECT_NE(text.find(part), std::string::npos) << b.what << ": " << text;
    }
  }
}

/// Calls `each` with every object of the document that has a value.
template <class Each>
void for_each_value(const json& j, const Each& each) {
  if (j.is_object() && j.contains("value")) each(j);
  if (j.is_structured()) {
    for (const json& part : j) for_each_value(part, each);
  }
}

/// The number of numbers in the document.
std::size_t numbers_in(const json& j) {
  if (j.is_number()) return 1;
  std::size_t count = 0;
  if (j.is_structured()) {
    for (const json& part : j) count += numbers_in(part);
  }
  return count;
}

TEST(Scenes, EveryNumberOfEveryShippedSceneHasASource) {
  const std::vector<std::string> expected{"driving",    "game-world", "haptics", "recorded",
                                          "rendezvous", "robot-cell", "room"};
  EXPECT_EQ(scene_names(), expected);
  for (const std::string& name : scene_names()) {
    const Scene scene = load_scene(name);
    EXPECT_EQ(scene.name, name);
    const json j = json_of_scene(name);
    std::size_t sourced = 0;
    for_each_value(j, [&](const json& number) {
      if (number.at("value").is_number()) ++sourced;
      const auto source = number.at("source").get<std::string>();
      EXPECT_GE(source.size(), 8u) << name << ": " << source;
    });
    EXPECT_EQ(sourced, numbers_in(j)) << name;
  }
}

TEST(Scenes, AnUnknownNameListsTheKnownOnes) {
  try {
    load_scene("moon");
    ADD_FAILURE();
  } catch (const BadInput& e) {
    EXPECT_NE(std::string(e.what()).find("robot-cell"), std::string::npos) << e.what();
  }
}

/// Calls `each` with some cases of every query of every scene, in both scalars.
template <class Each>
void for_each_drawn(std::uint64_t cases, const Each& each) {
  for (const std::string& name : scene_names()) {
    const Scene scene = load_scene(name);
    for (const MixedQuery& m : scene.queries) {
      for (const Scalar scalar : {Scalar::float32, Scalar::float64}) {
        for (std::uint64_t i = 0; i < cases; ++i) each(scene, m, draw_case(scene, *m.query, scalar, 7, i));
      }
    }
  }
}

TEST(Scenes, CasesAreValidExactAndTheSameForTheSameSeed) {
  for_each_drawn(40, [](const Scene& scene, const MixedQuery& m, const Case& c) {
    EXPECT_FALSE(c.query->broken(c.values));
    for (const double x : c.values) EXPECT_TRUE(std::isfinite(x) && representable(x, c.scalar));
    EXPECT_EQ(c.values, draw_case(scene, *m.query, c.scalar, 7, c.index).values) << scene.name;
    EXPECT_EQ(c.origin, "scene " + scene.name);
  });
  const Scene scene = load_scene("game-world");
  const Query& q = *scene.queries.front().query;
  EXPECT_NE(draw_case(scene, q, Scalar::float32, 1, 0).values, draw_case(scene, q, Scalar::float32, 2, 0).values);
  EXPECT_NE(draw_case(scene, q, Scalar::float32, 1, 0).values, draw_case(scene, q, Scalar::float32, 1, 1).values);
}

/// Positions are within the cube, but for the reach of the shapes, the way of the step and rounding.
TEST(Scenes, CasesLieInTheWorldOfTheScene) {
  for_each_drawn(60, [](const Scene& scene, const MixedQuery& m, const Case& c) {
    if (scene.is_recorded()) return;
    const auto& [first, second] = std::pair(scene.shapes[m.operands[0]], scene.shapes[m.operands[1]]);
    const double reach =
        4 * (first.size.most.value + second.size.most.value) + first.speed.most.value * scene.step.value;
    const bool ray = query_plan(*m.query)->direction.has_value();  // which may start anywhere in the cube
    const double most = scene.distance.most.value + scene.extent.value * (ray ? 2 : 1) + reach + 1;
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      if (c.role(i) != Role::position) continue;
      EXPECT_LE(std::abs(c.values[i]), most) << scene.name << " " << c.query->name;
    }
  });
}

TEST(Scenes, EveryQueryOfTheMixIsDrawnByItsWeight) {
  constexpr std::uint64_t draws = 4000;
  for (const std::string& name : scene_names()) {
    const Scene scene = load_scene(name);
    std::map<const Query*, int> counts;
    for (std::uint64_t i = 0; i < draws; ++i) ++counts[&drawn_query(scene, 3, i)];
    EXPECT_EQ(counts.size(), scene.queries.size()) << name;
    for (const MixedQuery& m : scene.queries) {
      const double expected = draws * scene.share_of(*m.query);
      const double deviation = std::sqrt(expected);  // at most that of a binomial distribution
      EXPECT_NEAR(counts[m.query], expected, 6 * deviation) << name << " " << m.query->name;
    }
  }
}

/// A generator that drifts apart or into each other would make every measurement on the scene empty.
TEST(Scenes, HitsAndMissesAreMixed) {
  constexpr std::uint64_t cases = 200;
  for (const std::string& name : scene_names()) {
    const Scene scene = load_scene(name);
    if (scene.is_recorded()) continue;
    for (const MixedQuery& m : scene.queries) {
      if (!decides(m.query->kind)) continue;
      std::uint64_t hits = 0;
      for (std::uint64_t i = 0; i < cases; ++i) {
        const Case c = draw_case(scene, *m.query, scene.scalar, 5, i);
        hits += oracle_of(*c.query).exact(c.values, Answer{}, c.scalar, nullptr).may_be_yes ? 1 : 0;
      }
      EXPECT_GE(hits, cases / 20) << name << " " << m.query->name;
      EXPECT_LE(hits, cases - cases / 20) << name << " " << m.query->name;
    }
  }
}

TEST(Scenes, TheNormalOfASurfacePointBoundsTheSolid) {
  constexpr double rounding = 0x1p-45;  // some roundings of numbers of about 1
  for (const Shape type : scene_shapes) {
    if (has_one_plane(type)) continue;
    const Sourced one{1, "test"};
    const Shapes shapes{"solid", type, one, {{0.25, "test"}, one, true}, {}};
    Random random(std::uint64_t(type) + 1);
    for (int i = 0; i < 300; ++i) {
      const Solid s = draw_solid(random, shapes);
      const SurfacePoint p = draw_surface_point(random, s);
      EXPECT_NEAR(length_of(p.normal), 1, rounding);
      EXPECT_NEAR(dot(s.support(p.normal), p.normal), dot(p.at, p.normal), 4 * rounding) << name_of(type);
    }
  }
}

TEST(Scenes, ALogarithmicSpreadHasAsManyOfEachOrder) {
  const Spread spread{{1, "test"}, {1024, "test"}, true};
  Random random(1);
  constexpr int draws = 10'000;
  std::map<int, int> octaves;
  for (int i = 0; i < draws; ++i) {
    const double x = draw_from(random, spread);
    ASSERT_TRUE(x >= 1 && x <= 1024);
    ++octaves[std::ilogb(x)];
  }
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(octaves[k], draws / 10.0, 6 * std::sqrt(draws / 10.0)) << k;
}

/// The first round asks the recorded cases as they are; the next ones move a shape by at most eight times the
/// tolerance.
TEST(Scenes, RecordedCasesComeAsTheyAreAndThenMoved) {
  const Scene scene = load_scene("robot-cell");
  const double most = 8 * scene.required.position_error.value;
  for (const MixedQuery& m : scene.queries) {
    for (std::size_t i = 0; i < m.recorded.size(); ++i) {
      const std::vector<double>& own = scene.recorded[m.recorded[i]].values;
      EXPECT_EQ(draw_case(scene, *m.query, Scalar::float64, 1, i).values, own);
      const std::vector<double> moved = draw_case(scene, *m.query, Scalar::float64, 1, i + m.recorded.size()).values;
      EXPECT_NE(moved, own);
      for (std::size_t k = 0; k < own.size(); ++k) {
        const bool may_move = m.query->inputs[k].role == Role::position;
        EXPECT_LE(std::abs(moved[k] - own[k]), may_move ? most * 1.001 : 0) << m.query->inputs[k].name;
      }
    }
  }
}

/// A file in the temporary folder of tests, removed by the destructor.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& text) : path_(testing::TempDir() + name) {
    std::ofstream(path_) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

TEST(Scenes, RecordedFilesAreReadInBothFormats) {
  const TemporaryFile lines(
      "scenes_test.jsonl",
      "{\"query\": \"sphere_sphere_overlap\", \"scalar\": \"float\", \"values\": [0.1, 0, 0, 1, 2, 0, 0, 1]}\n\n");
  const TemporaryFile rows("scenes_test.csv",
                           "query,scalar,values\nsphere_sphere_overlap, float, 0.1,0,0,1,2,0,0,1\r\n");
  const std::vector<Case> of_lines = read_json_lines(lines.path()), of_rows = read_csv(rows.path());
  ASSERT_EQ(of_lines.size(), 1u);
  ASSERT_EQ(of_rows.size(), 1u);
  EXPECT_EQ(of_lines[0].values, of_rows[0].values);
  EXPECT_EQ(of_lines[0].values[0], double(0.1f));
  const TemporaryFile again("scenes_test_again.jsonl", json_lines(of_lines));
  EXPECT_EQ(read_json_lines(again.path())[0].values, of_lines[0].values);
}

/// A run of a shipped scene rounds nothing: its cases are exact.
TEST(Scenes, ShippedCasesAreExact) {
  const std::uint64_t before = rounded_numbers().count;
  for (const std::string& name : scene_names()) EXPECT_FALSE(load_scene(name).queries.empty());
  EXPECT_EQ(rounded_numbers().count, before);
}

struct BrokenRecord {
  const char* line;
  std::vector<std::string> says;
};
const BrokenRecord broken_records[] = {
    {R"({"query": "moon", "scalar": "float", "values": []})", {"unknown query 'moon'"}},
    {R"({"query": "sphere_sphere_overlap", "scalar": "half", "values": []})", {"scalar is \"half\""}},
    {R"({"query": "sphere_sphere_overlap", "scalar": "double", "values": [1]})", {"1 numbers", "must have 8"}},
    {R"({"query": "sphere_sphere_overlap", "scalar": "double", "values": [0, 0, 0, -1, 2, 0, 0, 1]})",
     {"sphere1.radius", "-1", "not negative"}},
    {R"({"query": "sphere_sphere_overlap", "scalar": "double", "values": [0, 0, 0, "1", 2, 0, 0, 1]})",
     {"values[3]", "a number"}},
    {R"({"query": "sphere_sphere_overlap", "scalar": "float", "values": [1e300, 0, 0, 1, 2, 0, 0, 1]})",
     {"values[0], sphere1.center.x", "within the range of float"}},
    {"[1]", {"an object"}},
    {"{\"query\"", {"parse error"}},
};

TEST(Scenes, ARecordThatBreaksARuleStatesFileLineFieldAndRule) {
  for (const BrokenRecord& b : broken_records) {
    const TemporaryFile file("scenes_test_broken.jsonl", std::string("\n") + b.line + "\n");
    try {
      read_json_lines(file.path());
      ADD_FAILURE() << b.line;
    } catch (const BadInput& e) {
      const std::string text = e.what();
      EXPECT_NE(text.find("scenes_test_broken.jsonl:2"), std::string::npos) << text;
      for (const std::string& part : b.says) EXPECT_NE(text.find(part), std::string::npos) << text;
    }
  }
  const TemporaryFile empty("scenes_test_empty.jsonl", "\n");
  EXPECT_THROW(read_json_lines(empty.path()), BadInput);
}

}  // namespace
}  // namespace nearmiss::scenes
