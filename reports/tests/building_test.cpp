/// Subjects that are built, and joined to a night, when they are asked.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/host/hosts.hpp"
#include "reports/tests/program.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::json;

/// A launcher that writes its arguments to a file, and then does what the lines say.
std::string launcher(const TemporaryFolder& folder, const std::string& lines) {
  const fs::path file =
      folder.file("launcher", "#!/bin/sh\necho \"$@\" >>" + (folder / "asked").string() + "\n" + lines);
  fs::permissions(file, fs::perms::owner_all);
  return std::string(launcher_variable) + "=" + file.string();
}

const std::vector<std::string> one_case{"run", "-q", "sphere_sphere_overlap", "--cases", "1", "--seed", "1", "--out"};

Ran run_of(const TemporaryFolder& folder, const std::string& launcher, std::vector<std::string> options) {
  std::vector<std::string> arguments = one_case;
  arguments.push_back((folder / "r").string());
  arguments.insert(arguments.end(), options.begin(), options.end());
  return nearmiss(arguments, {launcher});
}

/// The launcher is asked for the chosen subjects, all at once.
TEST(SubjectsToBuild, AreThoseThatACommandAsks) {
  const TemporaryFolder folder;
  const Ran ran = run_of(folder, launcher(folder, ""), {"-s", "collide-fast-double", "-s", "collide-certified-float"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(read_file(folder / "asked"), "build collide-fast-double collide-certified-float\n");
}

TEST(SubjectsToBuild, AreNoneForAListOrAManual) {
  const TemporaryFolder folder;
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"list"}, {"list", "--json"}, {"list", "--names", "subjects"}, {"help", "run"}}) {
    EXPECT_EQ(nearmiss(words, {launcher(folder, "exit 1")}).exit_code, 0);
  }
  EXPECT_FALSE(fs::exists(folder / "asked"));
}

TEST(SubjectsToBuild, AreNamedWhereTheyCannotBeBuilt) {
  const TemporaryFolder folder;
  const Ran ran = run_of(folder, launcher(folder, "exit 2"), {"-s", "collide-fast-double"});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.err.find("could not build collide-fast-double\n"), std::string::npos) << ran.err;
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
}

/// The command line of a night whose launcher finishes these steps, of which it tells as the launcher does.
std::vector<std::string> night_with(const TemporaryFolder& folder, const std::string& steps, const char* minutes) {
  return {"-c", "exec {built}< <(" + steps + "); NEARMISS_BUILDING=$built exec " + nearmiss_program() +
                    " nightly --no-triage --minutes " + minutes + " --seed 5 --fuzz-targets " + folder.path().string() +
                    " --out " + (folder / "r").string()};
}

std::set<std::string> asked_in(const TemporaryFolder& folder) {
  std::set<std::string> asked;
  const json index = json::parse(read_file(folder / "r" / "index.json"));
  for (const json& t : index.at("tallies")) {
    if (t.at("cases") > 0) asked.insert(t.at("subject"));
  }
  return asked;
}

/// The first subjects are asked while the launcher still builds: it waits here for a report of theirs. The night goes
/// on until a tier, which has joined, has been asked.
TEST(NightWhileBuilding, BeginsWithTheSubjectsThatAreThere) {
  if (find_subject("ode") == nullptr) GTEST_SKIP() << "ode is not in this build";
  const TemporaryFolder folder;
  const std::string findings = (folder / "r" / "findings").string();
  const std::string steps = "echo subjects ode; until [ -d " + findings + " ]; do sleep 0.01; done; ls " + findings +
                            "/*/ >" + (folder / "first").string() + "; echo hosts; echo properties; echo targets";
  Started night("/bin/bash", night_with(folder, steps, "60"), {});
  std::set<std::string> asked;
  for (int i = 0; i < 2000 && !asked.contains("collide-fast-double"); ++i) {
    if (night.wait(0.1)) break;
    if (fs::exists(folder / "r" / "index.json")) asked = asked_in(folder);
  }
  EXPECT_TRUE(asked.contains("collide-fast-double")) << "it has not joined";
  night.send(SIGTERM);
  EXPECT_TRUE(night.wait(100).has_value());
  EXPECT_NE(read_file(folder / "first").find("ode-"), std::string::npos);
  EXPECT_EQ(read_file(folder / "first").find("collide-"), std::string::npos);
}

/// A night without its fuzz targets is no whole night.
TEST(NightWhileBuilding, SaysWhatItLacked) {
  const TemporaryFolder folder;
  const Ran ran = run_program("/bin/bash", night_with(folder, "echo subjects; echo hosts", "0.1"));
  EXPECT_GE(ran.exit_code, 1) << ran.out;
  EXPECT_NE(ran.err.find("lacked what the launcher could not build"), std::string::npos) << ran.err;
  EXPECT_NE(ran.out.find("properties: not built\n"), std::string::npos) << ran.out;
}

TEST(NightWhileBuilding, EndsWhereItsSubjectsCannotBeBuilt) {
  const TemporaryFolder folder;
  const Ran ran = run_program("/bin/bash", night_with(folder, "echo subjects", "0.1"));
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.err.find("could not build the subjects"), std::string::npos) << ran.err;
}

/// The commands of the launcher itself print their manuals, and build nothing for it.
TEST(Launcher, PrintsTheManualsOfItsOwnCommands) {
  const std::string launcher = source_folder() + "/nearmiss";
  for (const char* command : {"check", "build", "engines"}) {
    const std::string start = std::string("./nearmiss ") + command;
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"help", command}, {command, "--help"}, {command, "-h"}, {command, "x", "--help"}}) {
      const Ran ran = run_program(launcher, words);
      EXPECT_EQ(ran.exit_code, 0) << command << ran.err;
      EXPECT_TRUE(ran.out.starts_with(start + " ")) << ran.out;
      EXPECT_EQ(ran.out.find("./nearmiss", 1), std::string::npos) << "of one command: " << ran.out;
      EXPECT_EQ(ran.err, "");
    }
    EXPECT_NE(nearmiss({"help"}).out.find(command), std::string::npos);
  }
}

}  // namespace
}  // namespace nearmiss
