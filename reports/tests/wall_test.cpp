/// What docs/explanation/threat-model.md promises, in each way in which Nearmiss is used: what a subject tries against
/// the judge, its neighbours and the system does not succeed, and costs only its own cases.
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/tests/program.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

enum class Way { superuser, chroot, user, container, container_root };

const char* name_of(Way way) {
  constexpr const char* names[] = {"superuser", "chroot", "user", "container", "container-root"};
  return names[std::size_t(way)];
}
bool is_ordinary(Way way) { return way == Way::user || way == Way::container; }

constexpr int impossible = 77;

Ran nearmiss_in(Way way, std::vector<std::string> arguments, const std::vector<std::string>& environment) {
  arguments.insert(arguments.begin(), nearmiss_program());
  if (way == Way::superuser) {
    arguments.insert(arguments.begin(), {"-C", source_folder()});
    return run_program("env", arguments, environment);
  }
  arguments.insert(arguments.begin(), {source_folder(), name_of(way)});
  return run_program(in_a_way(), arguments, environment);
}

/// A folder in which every user may write.
fs::path new_open_folder(const TemporaryFolder& in, const std::string& name) {
  fs::create_directory(in / name);
  fs::permissions(in / name, fs::perms::all);
  return in / name;
}

class InWay : public testing::TestWithParam<Way> {
 protected:
  void SetUp() override {
    if (!is_ordinary(GetParam()) && geteuid() != 0) GTEST_SKIP() << "this test does not run as the superuser";
  }
  static std::vector<std::string> a_run(const std::vector<std::string>& subject, const fs::path& out) {
    std::vector<std::string> arguments{"run", "--patience", "20"};
    arguments.insert(arguments.end(), subject.begin(), subject.end());
    arguments.insert(arguments.end(), {"-q", "sphere_sphere_overlap", "-s", "zoo", "-s", "collide-fast-double",
                                       "--cases", "100", "--seed", "11", "--out", out.string()});
    return arguments;
  }
};

/// The text of each broken case, which the zoo wrote before its end; empty where the run is impossible.
std::vector<std::string> texts_of(const fs::path& run) {
  std::vector<std::string> texts;
  const json index = json::parse(read_file(run / "index.json"));
  for (const json& listed : index.at("reports")) {
    const json report = json::parse(read_file(run / listed.at("file").get<std::string>()));
    if (report.at("finding").at("verdict") == "broke") texts.push_back(report.at("answer").at("reason"));
  }
  return texts;
}

/// The attacks that succeeded, without those that are allowed in the way.
std::set<std::string> successes_in(const std::string& text, Way way) {
  std::set<std::string> all;
  const std::size_t begin = text.find("succeeded:") + 10;
  std::istringstream words(text.substr(begin, text.find('.', begin) - begin));
  for (std::string word; words >> word;) all.insert(word);
  if (is_ordinary(way)) all.erase("writes_run_folder"), all.erase("writes_itself");  // the files are of its user
  constexpr long first_with_scopes = 6;
  const bool has_scopes = syscall(SYS_landlock_create_ruleset, nullptr, 0, 1) >= first_with_scopes;
  if (way == Way::container && !has_scopes) all.erase("neighbour_killed");
  return all;
}

TEST_P(InWay, NoAttackSucceeds) {
  for (const bool plugin : {true, false}) {
    const TemporaryFolder folder;
    const fs::path out = new_open_folder(folder, "out"), target = new_open_folder(folder, "target");
    if (!is_ordinary(GetParam())) fs::permissions(target, fs::perms::owner_all);
    const std::string file = plugin ? plugin_file("zoo") : zoo_program();
    const Ran ran = nearmiss_in(
        GetParam(), a_run({plugin ? "--plugin" : "--command", file}, out / "r"),
        {"NEARMISS_ZOO=ask-attacks", "NEARMISS_ZOO_TARGET=" + target.string(), "NEARMISS_ZOO_FILE=" + file});
    if (ran.exit_code == impossible) GTEST_SKIP() << ran.err;
    ASSERT_EQ(ran.exit_code, 1) << ran.out << ran.err;
    const std::vector<std::string> texts = texts_of(out / "r");
    EXPECT_GE(texts.size(), 1u);
    for (const std::string& text : texts) {
      EXPECT_NE(text.find("found judge supervisor neighbour; succeeded:"), std::string::npos) << text;
      EXPECT_EQ(successes_in(text, GetParam()), std::set<std::string>{}) << (plugin ? "a plugin" : "a program");
    }
  }
}

TEST_P(InWay, AnAssaultOnTheJudgeCostsOnlyItsCases) {
  const TemporaryFolder folder;
  const fs::path out = new_open_folder(folder, "out");
  const std::string mark = new_mark();
  const Ran ran = nearmiss_in(GetParam(), a_run({"--plugin", plugin_file("zoo")}, out / "r"),
                              {"NEARMISS_ZOO=ask-assault", "NEARMISS_ZOO_TARGET=" + out.string(), mark});
  if (ran.exit_code == impossible) GTEST_SKIP() << ran.err;
  ASSERT_EQ(ran.exit_code, 1) << ran.out << ran.err;
  EXPECT_TRUE(nothing_is_left(mark));
  const std::vector<std::string> texts = texts_of(out / "r");
  EXPECT_GE(texts.size(), 2u) << "a new host continues";
  for (const std::string& text : texts) EXPECT_EQ(text, "killed by signal 6 (Aborted): did its worst");
}

INSTANTIATE_TEST_SUITE_P(Wall, InWay,
                         testing::Values(Way::superuser, Way::chroot, Way::user, Way::container, Way::container_root),
                         [](const auto& of) {
                           std::string name = name_of(of.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// Files in a folder that only the superuser can reach.
class ClosedFolder : public testing::TestWithParam<Way> {
 protected:
  void SetUp() override {
    if (geteuid() != 0) GTEST_SKIP() << "this test does not run as the superuser";
    fs::create_directories(closed() / "inner");
    fs::permissions(closed(), fs::perms::owner_all);
  }
  fs::path closed() const { return folder_ / "closed"; }
  std::string copy_of(const std::string& file) const {
    const fs::path copy = closed() / "inner" / fs::path(file).filename();
    fs::copy_file(file, copy);
    return copy.string();
  }
  /// Runs few cases with the subject of these options.
  Ran asked(const std::vector<std::string>& options) const {
    // With this seed the overlap of the zoo, which computes in doubles, is right in every case.
    std::vector<std::string> all{"run", "-q",    "sphere_sphere_overlap", "--cases", "50", "--seed",
                                 "1",   "--out", (folder_ / "r").string()};
    all.insert(all.end(), options.begin(), options.end());
    return nearmiss_in(GetParam(), all, {});
  }
  TemporaryFolder folder_;
};

TEST_P(ClosedFolder, APluginThereIsAsked) {
  const Ran ran = asked({"-s", "zoo", "--plugin", copy_of(plugin_file("zoo"))});
  if (ran.exit_code == impossible) GTEST_SKIP() << ran.err;
  EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
}

TEST_P(ClosedFolder, AProgramThatOtherUsersMayNotReadIsAsked) {
  const std::string program = copy_of(zoo_program());
  fs::permissions(program, fs::perms::owner_all);
  const Ran ran = asked({"-s", "zoo", "--command", program});
  if (ran.exit_code == impossible) GTEST_SKIP() << ran.err;
  EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
}

TEST_P(ClosedFolder, AScriptThereIsAskedOrRefusedWithAdvice) {
  if (example_py().empty()) GTEST_SKIP() << "this system has no python3";
  const std::string python = example_py().substr(0, example_py().find(' '));
  copy_of(source_folder() + "/impl/program/nearmiss.py");  // which it imports
  const std::string script = copy_of(source_folder() + "/docs/example-program/balls.py");
  const Ran ran = asked({"-s", "balls-py", "--command", python + " " + script});
  if (ran.exit_code == impossible) GTEST_SKIP() << ran.err;
  if (GetParam() != Way::container_root) {
    EXPECT_LE(ran.exit_code, 1) << ran.err;
    return;
  }
  EXPECT_EQ(ran.exit_code, 2) << ran.out;
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  EXPECT_NE(ran.err.find("who cannot read "), std::string::npos) << ran.err;
}

INSTANTIATE_TEST_SUITE_P(Wall, ClosedFolder, testing::Values(Way::superuser, Way::chroot, Way::container_root),
                         [](const auto& of) {
                           return std::string(of.param == Way::container_root ? "container_root" : name_of(of.param));
                         });

}  // namespace
}  // namespace nearmiss
