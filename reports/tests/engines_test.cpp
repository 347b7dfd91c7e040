/// Engines (docs/engines.md): subjects that are installed apart from the build and are asked only where they are named.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/host/engines.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string installed_in(const std::string& folder) { return std::string(engines_variable) + "=" + folder; }

void expect_one_line(const Ran& ran, const std::string& says) {
  EXPECT_EQ(ran.exit_code, 2) << ran.out;
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  EXPECT_NE(ran.err.find(says), std::string::npos) << ran.err;
}

/// A folder of installed engines in which jolt is installed, as far as its sign says, and its package is missing.
fs::path without_package(const TemporaryFolder& folder, const std::string& more = "") {
  const fs::path jolt = folder / "engines" / "jolt";
  fs::create_directories(jolt);
  write_file(jolt / "installed", read_file(source_folder() + "/impl/engines/jolt/package-lock.json") + more);
  return folder / "engines";
}

TEST(Engines, OneThatIsNotInstalledSaysHowToInstallIt) {
  const TemporaryFolder folder;
  const std::vector<std::string> none{installed_in((folder / "none").string())};
  constexpr const char* how = "jolt is not installed; './nearmiss engines jolt' installs it";
  expect_one_line(nearmiss({"run", "--subject", "jolt", "--cases", "1"}, none), how);
  expect_one_line(nearmiss({"run", "--subject", "jolt-strict", "--cases", "1"}, none),
                  "jolt-strict is not installed; './nearmiss engines jolt' installs it");
  json report = json::parse(read_file(source_folder() + "/corpus/upstream/ode/overlapping-boxes.json"));
  report["finding"] = json::object(), report["subject"] = {{"name", "jolt"}};
  const std::string file = folder.file("report.json", report.dump());
  expect_one_line(nearmiss({"minimise", file}, none), how);
  const Ran listed = nearmiss({"list"}, none);
  EXPECT_EQ(listed.exit_code, 0);
  EXPECT_EQ(listed.out.find("an engine"), std::string::npos) << listed.out;
  EXPECT_NE(listed.out.find("'./nearmiss engines NAME' installs cannon-es, embree, gts, havok, jolt, "),
            std::string::npos)
      << listed.out;
}

TEST(Engines, AnotherVersionIsNotInstalled) {
  const TemporaryFolder folder;
  const std::string other = without_package(folder, "\n").string();
  expect_one_line(nearmiss({"run", "--subject", "jolt", "--cases", "1"}, {installed_in(other)}),
                  "jolt is not installed");
}

TEST(Engines, OneThatDoesNotStartSaysWhyInOneLine) {
  if (example_js().empty()) GTEST_SKIP() << "this system has no node";
  const TemporaryFolder folder;
  const std::string broken = without_package(folder).string();
  expect_one_line(nearmiss({"run", "--subject", "jolt", "--cases", "1"}, {installed_in(broken)}),
                  "the engine jolt: left with exit code 1: Error: ENOENT");
}

TEST(Engines, NoneIsAskedWhereItIsNotNamed) {
  const TemporaryFolder folder;
  const std::string broken = without_package(folder).string();  // a start would end the command
  const Ran ran = nearmiss(
      {"run", "--query", "sphere_sphere_overlap", "--cases", "10", "--seed", "1", "--out", (folder / "r").string()},
      {installed_in(broken)});
  EXPECT_LE(ran.exit_code, 1) << ran.err;
  const json index = json::parse(read_file(folder / "r" / "index.json"));
  for (const json& t : index.at("tallies")) EXPECT_NE(t.at("subject"), "jolt");
}

/// The engines that are installed here, each as it is.
TEST(Engines, AnInstalledOneIsExaminedAndAskedAgainByItsName) {
  bool any = false;
  for (const Engine& engine : engines()) {
    if (!engine.is_installed) continue;
    any = true;
    SCOPED_TRACE(engine.name);
    const TemporaryFolder folder;
    const Ran ran =
        nearmiss({"run", "--subject", engine.name, "--cases", "500", "--seed", "7", "--out", (folder / "r").string()});
    ASSERT_LE(ran.exit_code, 1) << ran.err;
    const json index = json::parse(read_file(folder / "r" / "index.json"));
    std::size_t agrees = 0, all = 0;
    for (const json& t : index.at("tallies")) {
      EXPECT_EQ(t.at("subject"), engine.name);
      agrees += t.at("verdicts").at("agrees").get<std::size_t>(), all += 500;
    }
    EXPECT_GT(2 * agrees, all) << "it gets the cases and is understood";
    ASSERT_FALSE(index.at("reports").empty());
    const fs::path file = folder / "r" / index.at("reports").at(0).at("file").get<std::string>();
    const json report = json::parse(read_file(file));
    EXPECT_EQ(complaints(report, "report.schema.json"), "");
    const Ran again = nearmiss({"replay", "--json", file.string()});
    EXPECT_EQ(again.exit_code, 1) << again.err;
    const json replayed = json::parse(again.out);
    EXPECT_TRUE(
        std::any_of(replayed.begin(), replayed.end(), [&](const json& r) { return r.at("id") == report.at("id"); }));
    const json listed = json::parse(nearmiss({"list", "--json"}).out);
    EXPECT_EQ(listed.at("queries").at(0).at("engines").count(engine.name), 1u);
    EXPECT_EQ(listed.at("queries").at(0).at("subjects").count(engine.name), 0u);
  }
  if (!any) GTEST_SKIP() << "no engine is installed; './nearmiss engines NAME' installs one";
}

/// An adapter with another direction of the normal or another order of the points would make every answer a finding.
TEST(Engines, ASignedDistanceHasItsDirectionAndItsOrder) {
  const json listed = json::parse(nearmiss({"list", "--json"}).out);
  bool any = false;
  for (const Engine& engine : engines()) {
    if (!engine.is_installed) continue;
    std::vector<std::string> command{"check-subject", "--subject", engine.name};
    for (const json& q : listed.at("queries")) {
      const std::string query = q.at("query");
      if (query.ends_with("_signed_distance") && q.at("engines").at(engine.name) == "answers")
        command.insert(command.end(), {"--query", query});
    }
    if (command.size() == 3) continue;
    any = true;
    SCOPED_TRACE(engine.name);
    const Ran ran = nearmiss(command);
    EXPECT_LE(ran.exit_code, 1) << ran.err;
    EXPECT_NE(ran.out.find(" answered without a mistake"), std::string::npos) << ran.out;
    for (const char* meaning : {"points the other way", "is that of another one"})
      EXPECT_EQ(ran.out.find(meaning), std::string::npos) << ran.out;
  }
  if (!any) GTEST_SKIP() << "no engine with signed distances is installed";
}

}  // namespace
}  // namespace nearmiss
