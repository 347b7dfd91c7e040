/// The example programs of docs/reference/protocol.md: each is a subject like any other.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;

struct Example {
  std::string name;
  std::string command;  ///< "@" stands for a folder of the test
  bool moves;           ///< it offers moving_point_sphere as well
  std::string needs{};  ///< programs, with a space between two; the test is skipped where one is missing
  std::string build{};  ///< a command line that runs in docs/example-program first
};

std::string in_folder(std::string text, const TemporaryFolder& folder) {
  for (std::size_t at = 0; (at = text.find('@', at)) != std::string::npos;) text.replace(at, 1, folder.path().string());
  return text;
}

/// Which of the programs this system lacks.
std::string missing_of(const std::string& programs) {
  std::istringstream words(programs);
  for (std::string word; words >> word;) {
    if (run_program("bash", {"-c", "command -v " + word}).exit_code != 0) return word;
  }
  return "";
}

void PrintTo(const Example& e, std::ostream* out) { *out << e.name; }

class ExampleProgram : public testing::TestWithParam<Example> {};

TEST_P(ExampleProgram, IsExamined) {
  const Example& e = GetParam();
  if (e.command.empty()) GTEST_SKIP() << "this system has nothing to run it";
  if (const std::string missing = missing_of(e.needs); !missing.empty()) GTEST_SKIP() << "needs " << missing;
  const TemporaryFolder folder;
  const std::string command = in_folder(e.command, folder);
  const Ran built = run_program(
      "bash", {"-c", "cd " + source_folder() + "/docs/example-program && " + in_folder(e.build, folder) + ":"});
  ASSERT_EQ(built.exit_code, 0) << built.out << built.err;
  const Ran ran = run_program("bash", {"-c", R"(cd "$1" && shift && exec "$@")", "bash", source_folder(),
                                       nearmiss_program(), "run", "--command", command, "--subject", e.name, "--cases",
                                       "3000", "--seed", "3", "--out", (folder / "r").string()});
  ASSERT_LE(ran.exit_code, 1) << ran.err;
  const json index = json::parse(read_file(folder / "r" / "index.json"));
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  std::map<std::string, json> tallies;
  for (const json& t : index.at("tallies")) tallies[t.at("query").get<std::string>()] = t;
  ASSERT_EQ(tallies.size(), e.moves ? 2u : 1u);
  for (const auto& [query, t] : tallies) {
    EXPECT_EQ(t.at("cases"), 3000) << query;
    EXPECT_EQ(t.at("verdicts").at("broke"), 0) << query << t.at("breakages");
  }
  const json& overlap = tallies.at("sphere_sphere_overlap");
  EXPECT_GT(overlap.at("verdicts").at("agrees"), 2900) << "it gets the cases and is understood";
  EXPECT_GT(overlap.at("yes_share"), 0.1);
  if (e.moves) {
    EXPECT_GT(tallies.at("moving_point_sphere").at("verdicts").at("agrees"), 1900);
  }
  // A finding is asked again by the command that its report names.
  for (const json& listed : index.at("reports")) {
    const json report = json::parse(read_file(folder / "r" / listed.at("file").get<std::string>()));
    EXPECT_EQ(complaints(report, "report.schema.json"), "");
    const Ran without = nearmiss({"replay", (folder / "r" / listed.at("file").get<std::string>()).string()});
    EXPECT_NE(without.err.find("it is about '" + e.name), std::string::npos) << without.err;
    const Ran again =
        run_program("bash", {"-c", "cd /; " + report.at("replay").get<std::string>().replace(0, 8, nearmiss_program()) +
                                       " --json --subject " + e.name});
    EXPECT_EQ(again.exit_code, 1) << again.err;
    EXPECT_EQ(json::parse(again.out).at(0).at("id"), listed.at("id"));
    break;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, ExampleProgram,
    testing::Values(
        Example{"balls-py", example_py(), true}, Example{"balls-js", example_js(), true},
        Example{"balls-c", example_c(), false},
        Example{"balls-rs", "@/balls", true, "rustc", "rustc --edition 2021 -O -o @/balls balls.rs &&"},
        Example{"balls-go", "@/balls", true, "go", "GOCACHE=@/cache go build -o @/balls balls.go &&"},
        Example{"balls-java", "java -cp @ Balls", true, "javac java", "javac -Xlint:all -Werror -d @ Balls.java &&"},
        Example{"balls-cs", "mono @/balls.exe", true, "mcs mono", "mcs -warnaserror -out:@/balls.exe Balls.cs &&"}),
    [](const auto& of) {
      std::string name = of.param.name;
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

}  // namespace
}  // namespace nearmiss
