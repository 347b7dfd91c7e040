/// The example programs of docs/reference/protocol.md: each is a subject like any other.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
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

/// docs/bring-your-own.md begins with a whole subject.
TEST(ExampleProgram, OfThePageIsASubject) {
  if (python().empty()) GTEST_SKIP() << "this system has no Python";
  const std::string page = read_file(source_folder() + "/docs/bring-your-own.md"), open = "```python\n";
  const std::size_t begin = page.find(open) + open.size();
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "program");
  const std::string file = folder.file("program/mine.py", page.substr(begin, page.find("```", begin) - begin));
  std::filesystem::copy(source_folder() + "/impl/program/nearmiss.py", folder / "program/nearmiss.py");
  const std::string command = python() + " " + file;
  const Ran checked = nearmiss({"check-subject", "--command", command, "--subject", "mine"});
  EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
  EXPECT_EQ(checked.out, "mine: 1 of 1 query answered without a mistake\n");
  const Ran ran = nearmiss({"run", "--command", command, "--subject", "mine", "--cases", "1000", "--seed", "1", "--out",
                            (folder / "r").string()});
  EXPECT_LE(ran.exit_code, 1) << ran.err;
}

/// The lines of docs/bring-your-own.md that begin with "./nearmiss COMMAND --command".
TEST(ExampleProgram, CommandsOfThePageTakeAProgram) {
  std::istringstream page(read_file(source_folder() + "/docs/bring-your-own.md"));
  std::set<std::string> commands;
  for (std::string line; std::getline(page, line);) {
    std::istringstream words(line);
    std::string launcher, command, option;
    words >> launcher >> command >> option;
    if (launcher == "./nearmiss" && option == "--command") commands.insert(command);
  }
  EXPECT_EQ(commands, (std::set<std::string>{"check-subject", "explain", "minimise", "run", "show", "triage"}));
  for (const std::string& command : commands)
    EXPECT_NE(nearmiss({command, "--help"}).out.find("--command COMMAND"), std::string::npos) << command;
}

/// The page lists the commands that take a plugin: all that do.
TEST(ExampleProgram, ThePageListsTheCommandsThatTakeAPlugin) {
  const std::string page = read_file(source_folder() + "/docs/bring-your-own.md"),
                    open = "These commands take `--plugin FILE`:";
  const std::size_t begin = page.find(open);
  ASSERT_NE(begin, std::string::npos);
  std::string list = page.substr(begin + open.size(), page.find('.', begin) - begin - open.size());
  std::set<std::string> listed, taking;
  for (std::size_t at = list.find('`'); at != std::string::npos; at = list.find('`', at)) {
    const std::size_t end = list.find('`', at + 1);
    listed.insert(list.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  std::istringstream manual(nearmiss({"help"}).out);
  std::string line;
  while (std::getline(manual, line) && line != "COMMANDS") {
  }
  while (std::getline(manual, line) && !line.empty()) {
    std::string name;
    std::istringstream(line) >> name;
    if (nearmiss({name, "--help"}).out.find("--plugin FILE") != std::string::npos) taking.insert(name);
  }
  EXPECT_EQ(listed, taking);
}

/// What newcomers get wrong is told in one line that says what to do.
TEST(ExampleProgram, AMistakeOfANewcomerIsTold) {
  if (python().empty()) GTEST_SKIP() << "this system has no Python";
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "program");
  std::filesystem::copy(source_folder() + "/impl/program/nearmiss.py", folder / "program/nearmiss.py");
  const auto command = [&](const std::string& name, const std::string& text) {
    return python() + " " + folder.file("program/" + name, "import nearmiss\n" + text);
  };
  const std::string answers_nothing = command("nothing.py", "print('ready')\n"), hit = command("hit.py", R"(
def meet(q):
    return q.other.radius > 0
nearmiss.answer(name="hit", scalar="double", queries={"sphere_sphere_overlap": meet})
)");
  const auto refused = [](const Ran& ran, const char* says) {
    EXPECT_EQ(ran.exit_code, 2) << says;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_NE(ran.err.find(says), std::string::npos) << ran.err;
  };
  refused(nearmiss({"list", "--command", answers_nothing}),
          "left with exit code 0: ready. It never said hello: with nearmiss.py or nearmiss.mjs, call their function");
  refused(nearmiss({"check-subject", "--command", hit, "--subject", "mine"}),
          "unknown subject 'mine'; what was added calls itself 'hit'");
  refused(nearmiss({"list", "--command", hit, "--declare", "mine: two-sided"}),
          "unknown subject 'mine'; what was added calls itself 'hit'");
  const std::string balls = python() + " " + source_folder() + "/docs/example-program/balls.py";
  refused(nearmiss({"check-subject", "--command", hit, "--command", balls, "--subject", "mine"}),
          "those that were added call themselves 'hit' and 'balls-py'");
  refused(nearmiss({"check-subject", "--command", hit, "--subject", "hits"}),
          "unknown subject 'hits'; did you mean hit");
  const Ran broken = nearmiss({"check-subject", "--command", hit, "--subject", "hit"});
  std::string words = broken.out;  // without the ends of lines
  for (std::size_t at = 0; (at = words.find("\n  ", at)) != std::string::npos;) words.replace(at, 3, " ");
  EXPECT_NE(words.find("AttributeError: hit.py, line 4, sphere_sphere_overlap: 'other' is no input of "
                       "sphere_sphere_overlap: it has sphere1, sphere2"),
            std::string::npos)
      << broken.out;
}

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
