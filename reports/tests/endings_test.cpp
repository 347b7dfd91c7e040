/// Every command ends soon after any kind of end, leaves no process behind, and keeps its findings.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Seconds. The promise is one; the test allows more on a machine that runs other tests at the same time.
constexpr double soon = 20, long_enough = 60;

struct Command {
  const char* name;
  std::vector<std::string> arguments;
};

void PrintTo(const Command& c, std::ostream* out) { *out << c.name; }

class EveryCommand : public testing::TestWithParam<Command> {};

/// A subject that never answers, with a very long case timeout.
TEST_P(EveryCommand, EndsWhenItIsToldTo) {
  const TemporaryFolder folder;
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string mark = new_mark();
    std::vector<std::string> arguments = GetParam().arguments;
    for (std::string& a : arguments) {
      if (a == "OUT") a = (folder / std::to_string(signal)).string();
    }
    for (const std::string& more :
         std::vector<std::string>{"--patience", "3000", "--command", zoo_program(), "-s", "zoo"})
      arguments.emplace_back(more);
    Started command(nearmiss_program(), arguments, {mark, "NEARMISS_ZOO=always-sleeps"});
    // The command, a supervisor, the subject. A host that only sends its hello may be the third process, and ends soon.
    const auto awaits_its_subject = [&] {
      for (int i = 0; i < 1000; ++i, usleep(20'000)) {
        if (processes_with(mark).size() >= 3) return true;
      }
      return false;
    };
    EXPECT_TRUE(awaits_its_subject());
    EXPECT_FALSE(command.wait(0.5).has_value());
    EXPECT_TRUE(awaits_its_subject());
    command.send(signal);
    const std::optional<Ran> ran = command.wait(soon);
    ASSERT_TRUE(ran.has_value()) << "it goes on";
    if (ran->exit_code >= 0) {  // the command did not end by the signal
      EXPECT_EQ(ran->exit_code, 2) << ran->out << ran->err;
      EXPECT_NE(ran->err.find("interrupted"), std::string::npos) << ran->err;
    }
    EXPECT_TRUE(nothing_is_left(mark));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, EveryCommand,
    testing::Values(
        Command{"run", {"run", "-q", "sphere_sphere_overlap", "--out", "OUT"}},
        Command{"check_subject", {"check-subject", "-q", "sphere_sphere_overlap"}},
        Command{"relations", {"relations", "-q", "sphere_sphere_overlap", "--out", "OUT"}},
        Command{"extremes", {"extremes", "-q", "sphere_sphere_overlap", "--out", "OUT"}},
        Command{"import", {"import", "nyu-ccd", source_folder() + "/corpus/nyu-ccd/sample.csv"}},
        Command{"replay", {"replay", source_folder() + "/corpus/seeds/sphere_sphere_overlap/apart.json"}},
        Command{"minimise",
                {"minimise", source_folder() + "/corpus/seeds/sphere_sphere_overlap/apart.json", "--out", "OUT"}},
        Command{"explain",
                {"explain", source_folder() + "/corpus/seeds/sphere_sphere_overlap/apart.json", "--out", "OUT"}}),
    [](const auto& of) { return std::string(of.param.name); });

TEST(Nightly, EndsWhenItIsToldTo) {
  const TemporaryFolder folder;
  for (const double after : {0.5, 3.0}) {
    const std::string mark = new_mark();
    Started nightly(nearmiss_program(),
                    {"nightly", "--no-triage", "--minutes", "10", "--patience", "3000", "--command", zoo_program(),
                     "--out", (folder / std::to_string(after)).string()},
                    {mark, "NEARMISS_ZOO=always-sleeps"});
    EXPECT_FALSE(nightly.wait(after).has_value());
    nightly.send(SIGTERM);
    const std::optional<Ran> ran = nightly.wait(soon);
    ASSERT_TRUE(ran.has_value()) << "it goes on";
    EXPECT_TRUE(nothing_is_left(mark));
  }
}

TEST(Run, EndsWhenItsTimeIsOver) {
  const TemporaryFolder folder;
  Started run(nearmiss_program(),
              {"run", "-q", "sphere_sphere_overlap", "--seconds", "1", "--patience", "3000", "--command", zoo_program(),
               "-s", "zoo", "-s", "collide-fast-double", "--out", (folder / "r").string()},
              {"NEARMISS_ZOO=always-sleeps"});
  const std::optional<Ran> ran = run.wait(1 + soon);
  ASSERT_TRUE(ran.has_value()) << "it goes on";
  const json index = json::parse(read_file(folder / "r" / "index.json"));
  EXPECT_EQ(index.at("state"), "finished");
}

/// A subject that is always late is given up by each of these commands.
TEST(EverySubject, IsGivenUpWhereItIsAlwaysLate) {
  const TemporaryFolder folder;
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"relations", "-q", "sphere_sphere_overlap", "--cases", "500", "--out",
                                 (folder / "r").string()},
        std::vector<std::string>{"import", "nyu-ccd", source_folder() + "/corpus/nyu-ccd/sample.csv"}}) {
    std::vector<std::string> all = arguments;
    for (const std::string& more :
         std::vector<std::string>{"--patience", "0.02", "--command", zoo_program(), "-s", "zoo"})
      all.emplace_back(more);
    Started command(nearmiss_program(), all, {"NEARMISS_ZOO=always-sleeps"});
    const std::optional<Ran> ran = command.wait(long_enough);
    ASSERT_TRUE(ran.has_value());
    EXPECT_NE((ran->out + ran->err).find("zoo was late 8 times"), std::string::npos) << ran->out << ran->err;
  }
  const json relations = json::parse(read_file(folder / "r" / "relations.json"));
  EXPECT_EQ(complaints(relations, "relations.schema.json"), "");
  EXPECT_EQ(relations.at("gave_up").size(), 1u);
}

/// What whoever starts a command has set, it has as well.
TEST(Cli, EndsWhereTheEndOfChildrenIsIgnored) {
  Started command("/usr/bin/env",
                  {"--ignore-signal=CHLD", nearmiss_program(), "run", "-q", "sphere_sphere_overlap", "-s",
                   "collide-fast-double", "--cases", "50", "--out", "/dev/null/none"},
                  {});
  const std::optional<Ran> ran = command.wait(soon);
  ASSERT_TRUE(ran.has_value());
  EXPECT_EQ(ran->exit_code, 2) << ran->err;
}

/// A host that could not get its own files must not write into those of the command.
TEST(Cli, StartsNoHostThatHasNotItsOwnFiles) {
  for (const int files : {10, 20, 40, 64, 90, 101, 104, 110, 128}) {
    const TemporaryFolder folder;
    const Ran ran =
        run_program("bash",
                    {"-c", "ulimit -n " + std::to_string(files) + "; exec '" + nearmiss_program() +
                               "' run --command '" + zoo_program() +
                               "' -s zoo -q sphere_sphere_overlap --cases 100 --out '" + (folder / "r").string() + "'"},
                    {"NEARMISS_ZOO=ask-json-to-output"});
    for (const std::string& text : {"\n" + ran.out, "\n" + ran.err}) {
      EXPECT_EQ(text.find("\n[{\"finding\""), std::string::npos) << files << text;
    }
    if (ran.exit_code == 2) {
      EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << files << ": " << ran.err;
      EXPECT_NE(ran.err.find("Too many open files"), std::string::npos) << ran.err;
    } else {
      EXPECT_EQ(ran.exit_code, 1) << files << ": " << ran.err;
    }
  }
}

/// Other programs may leave any files in a run folder.
TEST(Run, TakesNoHarmFromWhatIsBesideItsFolder) {
  const TemporaryFolder folder;
  constexpr std::size_t deep = 300'000;
  for (const std::string& text :
       {"{\n  \"schema\": 2,\n  \"state\": \"running\",\n  \"summary\": \"x\", \"reports\": [], \"x\": " +
            std::string(deep, '[') + std::string(deep, ']') + "}",
        std::string("{\n  \"state\": \"running\"}"),
        std::string("{\n  \"state\": \"running\", \"reports\": 7, \"summary\": []}"),
        std::string("{\n  \"state\": \"running\"")}) {
    fs::create_directories(folder / "beside");
    write_file(folder / "beside" / "index.json", text);
    const Ran ran = nearmiss({"run", "-s", "collide-fast-double", "-q", "sphere_sphere_overlap", "--cases", "5",
                              "--out", (folder / "r").string()});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(read_file(folder / "beside" / "index.json"), text);
  }
}

/// How often each command is killed; the nightly job sets more.
int kills() {
  const char* asked = std::getenv("NEARMISS_KILLS");
  return asked == nullptr ? 2 : std::max(1, std::atoi(asked));
}

/// Checks every file in the folder of a killed command, after another program wrote there.
void expect_whole(const fs::path& folder) {
  if (!fs::exists(folder)) return;  // the command had not begun
  std::set<std::string> on_disk, listed;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const fs::path file = entry.path();
    EXPECT_NE(file.extension(), ".part") << file;
    if (file.extension() != ".json") continue;
    const json j = json::parse(read_file(file), nullptr, false);
    EXPECT_FALSE(j.is_discarded()) << file << " is half written";
    const std::string name = file.lexically_relative(folder).generic_string();
    if (!name.starts_with("findings/")) continue;
    EXPECT_EQ(complaints(j, "report.schema.json"), "") << file;
    on_disk.insert(name);
  }
  if (!fs::exists(folder / "index.json")) {
    EXPECT_TRUE(on_disk.empty());
    return;
  }
  const json index = json::parse(read_file(folder / "index.json"));
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  EXPECT_NE(index.at("state"), "running");
  for (const json& r : index.at("reports")) listed.insert(r.at("file").get<std::string>());
  EXPECT_EQ(listed, on_disk);
}

void expect_to_survive_kills(const std::vector<std::string>& command, double seconds) {
  const TemporaryFolder folder;
  for (int i = 0; i < kills(); ++i) {
    const std::string mark = new_mark();
    const fs::path out = folder / ("killed-" + std::to_string(i));
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(),
                     {"--seed", std::to_string(i), "--plugin", plugin_file("zoo"), "--out", out.string()});
    Started killed(nearmiss_program(), arguments, {mark, "NEARMISS_ZOO=ask-leaves-an-orphan"});
    const double moment = std::fmod(0.618 * (i + 1), 1) * seconds;
    EXPECT_FALSE(killed.wait(moment).has_value());
    killed.send(SIGKILL);
    const std::optional<Ran> ran = killed.wait(soon);
    ASSERT_TRUE(ran.has_value());
    EXPECT_EQ(ran->exit_code, -SIGKILL);
    EXPECT_TRUE(nothing_is_left(mark)) << "killed after " << moment << " s";
    const Ran next = nearmiss({"run", "-s", "collide-fast-double", "-q", "sphere_sphere_overlap", "--cases", "5",
                               "--out", (folder / "next").string()});
    EXPECT_EQ(next.exit_code, 0) << next.err;
    expect_whole(out);
    if (testing::Test::HasFailure()) return;
    fs::remove_all(out);
  }
}

TEST(Killed, RunsLeaveNothingButWhatTheyFound) { expect_to_survive_kills({"run", "--seconds", "60"}, 3); }

TEST(Killed, NightsLeaveNothingButWhatTheyFound) {
  const TemporaryFolder targets;
  const fs::path target =
      targets.file("fuzz_sphere_sphere_overlap",
                   "#!/bin/sh\ntrap '' INT TERM\nsleep 600 & sleep 600\n" + std::string("\0max_total_time\0", 16));
  fs::permissions(target, fs::perms::owner_all);
  expect_to_survive_kills({"nightly", "--no-triage", "--minutes", "0.15", "--fuzz-targets", targets.path().string()},
                          8.5);
}

}  // namespace
}  // namespace nearmiss
