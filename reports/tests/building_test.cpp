/// Subjects that are built, and joined to a night, when they are asked.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "corpus/codec.hpp"
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

/// The launcher is asked for the chosen subjects, and for the referees where a report needs them: once for each.
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

/// Starts a night whose launcher finishes these steps, of which it tells as the launcher does.
Ran night_with(const TemporaryFolder& folder, const std::string& steps) {
  const std::string command = "exec {built}< <(" + steps + "); NEARMISS_BUILDING=$built exec " + nearmiss_program() +
                              " nightly --no-triage --minutes 0.1 --seed 5 --fuzz-targets " + folder.path().string() +
                              " --out " + (folder / "r").string();
  return run_program("/bin/bash", {"-c", command});
}

json tallies_of(const TemporaryFolder& folder) {
  return json::parse(read_file(folder / "r" / "index.json")).at("tallies");
}

/// The first subjects are asked while the launcher still builds: it waits here for a report of theirs, or for the end
/// of the night.
TEST(NightWhileBuilding, BeginsWithTheSubjectsThatAreThere) {
  if (find_subject("ode") == nullptr) GTEST_SKIP() << "ode is not in this build";
  const TemporaryFolder folder;
  const std::string findings = (folder / "r" / "findings").string();
  const Ran ran = night_with(folder, "echo subjects ode; for i in $(seq 3000); do [ -d " + findings +
                                         " ] && break; sleep 0.01; done; ls " + findings + "/*/ >" +
                                         (folder / "first").string() + "; echo hosts; echo properties; echo targets");
  EXPECT_LE(ran.exit_code, 1) << ran.err;
  EXPECT_NE(read_file(folder / "first").find("ode-"), std::string::npos) << ran.out << ran.err;
  EXPECT_EQ(read_file(folder / "first").find("bullet-"), std::string::npos);
  std::set<std::string> asked;
  for (const json& t : tallies_of(folder)) {
    if (t.at("cases") > 0) asked.insert(t.at("subject"));
  }
  for (const std::string& name : subject_names()) EXPECT_TRUE(asked.contains(name)) << name << " has not joined";
}

/// A night without its fuzz targets is no whole night.
TEST(NightWhileBuilding, SaysWhatItLacked) {
  const TemporaryFolder folder;
  const Ran ran = night_with(folder, "echo subjects; echo hosts");
  EXPECT_GE(ran.exit_code, 1) << ran.out;
  EXPECT_NE(ran.err.find("lacked what the launcher could not build"), std::string::npos) << ran.err;
  EXPECT_NE(ran.out.find("properties: not built\n"), std::string::npos) << ran.out;
}

TEST(NightWhileBuilding, EndsWhereItsSubjectsCannotBeBuilt) {
  const TemporaryFolder folder;
  const Ran ran = night_with(folder, "echo subjects");
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.err.find("could not build the subjects"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace nearmiss
