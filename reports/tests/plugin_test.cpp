/// A plugin is examined like any other subject, and an invalid one is refused in one line.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "corpus/storage/store.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST(Plugin, IsListedWithWhatItOffers) {
  const Ran ran = nearmiss({"list", "--plugin", plugin_file("skim_plugin"), "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const json list = json::parse(ran.out);
  for (const json& q : list.at("queries")) {
    const bool offered = q.at("query") == "sphere_sphere_overlap" || q.at("query") == "moving_point_sphere" ||
                         q.at("query") == "closest_point_segment";
    EXPECT_EQ(q.at("subjects").at("skim"), offered ? "answers" : "not offered") << q.at("query");
  }
}

/// docs/bring-your-own.md promises these three for the example.
TEST(Plugin, ThreeMistakesOfTheExampleAreFound) {
  const TemporaryFolder folder;
  const Ran ran = nearmiss({"run", "--plugin", plugin_file("skim_plugin"), "--subject", "skim", "--cases", "20000",
                            "--seed", "1", "--out", (folder / "r").string()});
  ASSERT_EQ(ran.exit_code, 1) << ran.err;
  const json index = json::parse(read_file(folder / "r" / "index.json"));
  std::map<std::string, std::uint64_t> violations;
  for (const json& t : index.at("tallies")) {
    for (const auto& [way, count] : t.at("disagreements").items()) {
      const auto n = count.at("violations").get<std::uint64_t>();
      if (n > 0) violations[t.at("query").get<std::string>() + ": " + way] = n;
    }
  }
  // Beyond a segment that is all but a point, where the contract may make it one, a place may be on none or on some.
  const std::uint64_t near_a_point = violations["closest_point_segment: wrong place"];
  EXPECT_LT(100 * near_a_point, violations["closest_point_segment: off the surface"]);
  violations.erase("closest_point_segment: wrong place");
  ASSERT_EQ(violations.size(), 3u) << ran.out;
  EXPECT_GT(violations["sphere_sphere_overlap: false hit"], 0u);
  EXPECT_GT(violations["moving_point_sphere: false miss"], 0u);
  EXPECT_GT(violations["closest_point_segment: off the surface"], 0u);
  for (const json& listed : index.at("reports")) {
    const json report = json::parse(read_file(folder / "r" / listed.at("file").get<std::string>()));
    EXPECT_EQ(complaints(report, "report.schema.json"), "");
    const Ran again = run_program(
        "bash",
        {"-c", report.at("replay").get<std::string>().replace(0, 8, nearmiss_program()) + " --subject skim --json"});
    EXPECT_EQ(again.exit_code, 1) << report.at("replay") << again.err;
    EXPECT_EQ(json::parse(again.out).at(0).at("id"), listed.at("id"));
  }
}

TEST(Plugin, CostsOneCaseWhateverItDoes) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments{"replay", "--json", "--plugin", plugin_file("misbehaves"), "-s", "misbehaves"};
  for (int what = 0; what < 4; ++what) {
    const fs::path file = folder / (std::to_string(what) + ".json");
    write_file(file, R"({"query": "sphere_sphere_overlap", "scalar": "double", "inputs": {"sphere1": {"center": [)" +
                         std::to_string(what) +
                         R"(, 0, 0], "radius": 1}, "sphere2": {"center": [9, 0, 0], "radius": 1}}})");
    arguments.push_back(file.string());
  }
  const Ran ran = nearmiss(arguments);
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  const json reports = json::parse(ran.out);
  ASSERT_EQ(reports.size(), 4u);
  const std::vector<std::string> reasons{"", "signal 6", "no answer within", "returned 7"};
  EXPECT_EQ(reports[0].at("finding").at("verdict"), "agrees");
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(reports[i].at("finding").at("verdict"), "broke");
    EXPECT_NE(reports[i].dump().find(reasons[i]), std::string::npos) << reports[i];
  }
}

/// Of subjects of this build.
json tallies_beside(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "run");
  const TemporaryFolder folder;
  for (const char* more : {"-s", "collide-certified-float", "-s", "collide-certified-double", "-s",
                           "collide-fast-float", "--cases", "400", "--seed", "3", "--out"}) {
    arguments.emplace_back(more);
  }
  arguments.push_back((folder / "r").string());
  const Ran ran = nearmiss(arguments);
  EXPECT_LE(ran.exit_code, 1) << ran.err;
  return json::parse(read_file(folder / "r" / "index.json")).at("tallies");
}

/// A program in Python, from the folder of the test; empty where there is no Python.
std::string program_in_python() {
  return python().empty() ? "" : python() + " " + source_folder() + "/docs/example-program/balls.py";
}

/// Which of two subjects a name stands for would be open.
TEST(Plugin, OfTheNameOfAnotherIsRefusedInOneLine) {
  const std::string file = (corpus_folder() / "seeds/sphere_sphere_overlap/touch.json").string();
  const std::string one = program_in_python(), other = "env " + one;
  if (one.empty()) GTEST_SKIP() << "there is no Python";
  const Ran ran = nearmiss({"replay", "--command", one, "--command", other, file});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  EXPECT_TRUE(ran.err.starts_with("nearmiss: " + other + ": there is a subject 'balls-py' already")) << ran.err;
}

/// A finding of a program names the option that adds the program, whatever command reads it.
TEST(Plugin, IsAddedAsTheReportSays) {
  if (example_py().empty()) GTEST_SKIP() << "there is no Python";
  const TemporaryFolder folder;
  const fs::path seed = corpus_folder() / "seeds/sphere_sphere_overlap/touch.json";
  const Ran asked =
      run_program("bash", {"-c", R"(cd "$1" && shift && exec "$@")", "bash", source_folder(), nearmiss_program(),
                           "replay", "--json", "--command", example_py(), "-s", "balls-py", seed.string()});
  const std::string file = folder.file("r.json", json::parse(asked.out).at(0).dump());
  for (const char* command : {"show", "explain", "minimise", "emit-test", "upstream-report"}) {
    const Ran ran = nearmiss({command, file});
    EXPECT_EQ(ran.exit_code, 2) << command;
    // From any folder: "cd '…' && exec PROGRAM".
    const std::size_t at = ran.err.find("this adds it, and starts '");
    EXPECT_TRUE(at != std::string::npos && ran.err.find(": --command 'cd ", at) != std::string::npos)
        << command << ": " << ran.err;
  }
}

/// The plugin sets flush to zero and upward rounding when it is loaded.
TEST(Plugin, KeepsItsModesOfArithmeticToItself) {
  const json alone = tallies_beside({});
  EXPECT_EQ(tallies_beside({"--plugin", plugin_file("sets_modes")}), alone);
  EXPECT_GT(alone.size(), 100u);
}

TEST(Plugin, IsAskedInTheModesThatItSets) {
  const Ran ran = nearmiss({"replay", "--plugin", plugin_file("sets_modes"), "--subject", "misbehaves", "--json",
                            source_folder() + "/corpus/seeds/sphere_sphere_overlap/overlap.json"});
  ASSERT_LE(ran.exit_code, 1) << ran.err;
  EXPECT_EQ(json::parse(ran.out).at(0).at("answer").at("yes"), true) << ran.out;
}

/// Its functions have no count of the inputs.
TEST(Plugin, OfTheVersionBeforeAnswersAsBefore) {
  const TemporaryFolder folder;
  const Ran ran = nearmiss({"run", "--plugin", plugin_file("second_version"), "--subject", "misbehaves", "--cases",
                            "400", "--seed", "1", "--out", (folder / "r").string(), "--measure", "0.001"});
  ASSERT_EQ(ran.exit_code, 0) << ran.out << ran.err;
  EXPECT_NE(ran.out.find("nothing violated"), std::string::npos) << ran.out;
}

struct Refused {
  const char *name, *says;
};

class BadPluginFile : public testing::TestWithParam<Refused> {};

TEST_P(BadPluginFile, IsRefusedInOneLine) {
  const std::string file = plugin_file(GetParam().name);
  const Ran ran = nearmiss({"list", "--plugin", file});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_EQ(ran.out, "");
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  EXPECT_TRUE(ran.err.starts_with("nearmiss: " + file + ": ")) << ran.err;
  EXPECT_NE(ran.err.find(GetParam().says), std::string::npos) << ran.err;
}

INSTANTIATE_TEST_SUITE_P(
    Faults, BadPluginFile,
    testing::Values(Refused{"nowhere", "there is no such file"}, Refused{"not_a_library", "it cannot be loaded"},
                    Refused{"no_entry", "no function nearmiss_plugin_entry"},
                    Refused{"other_version", "made for version 4"},
                    Refused{"first_version", "made for version 1 of nearmiss_plugin.h"},
                    Refused{"miscounts", "sphere_sphere_overlap has 8 inputs"},
                    Refused{"unknown_query", "'sphere_sphere_overlaps'"},
                    Refused{"taken_name", "there is a subject 'collide-fast-double' already"},
                    Refused{"contract_below_zero", "none may be below 0"},
                    Refused{"contract_of_nothing", "has a domain, from 2^-20 to 2^20, and promises nothing there"},
                    Refused{"contract_upside_down", "lowest 20 above highest -20"},
                    Refused{"unknown_need", "requires 0x80000000 for sphere_sphere_overlap"},
                    Refused{"crashes", "killed by signal 6 (Aborted)"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace nearmiss
