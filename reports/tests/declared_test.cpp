/// A subject is judged by what it declares: in an adapter, a plugin, a program or on the command line; so are its
/// stored reports.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "corpus/storage/codec.hpp"
#include "impl/catalogue/queries/sphere_sphere_overlap.hpp"
#include "impl/subject/offering.hpp"
#include "reports/engine/replay.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* two_sided = "rays: two-sided: Both sides count.";

/// A run of a plugin of two_sided_plugin.c, which writes into the folder.
Ran run_of(const char* plugin, const fs::path& folder, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{
      "run", "--plugin", plugin_file(plugin), "--subject", "rays", "--cases", "1500", "--seed",
      "1",   "--out",    folder.string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return nearmiss(arguments);
}
json index_in(const fs::path& folder) { return json::parse(read_file(folder / "index.json")); }
std::set<std::string> faults_in(const json& index) {
  std::set<std::string> faults;
  for (const json& r : index.at("reports")) faults.insert(r.at("disagreement"));
  return faults;
}

TEST(Declared, UndeclaredIsJudgedAsBefore) {
  const TemporaryFolder folder;
  const Ran ran = run_of("rays", folder / "r");
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  EXPECT_EQ(ran.out.find("declares"), std::string::npos) << ran.out;
  const json index = index_in(folder / "r");
  EXPECT_FALSE(index.contains("declared"));
  EXPECT_EQ(faults_in(index), std::set<std::string>{"false hit"});
  const Ran triaged =
      nearmiss({"triage", "--plugin", plugin_file("rays"), (folder / "r").string(), "--minutes", "0.2"});
  EXPECT_NE(triaged.out.find("declare \"rays: two-sided\", and "), std::string::npos) << triaged.out;
  const json triage = json::parse(read_file(folder / "r" / "triage" / "triage.json"));
  EXPECT_EQ(complaints(triage, "triage.schema.json"), "");
  ASSERT_EQ(triage.at("proposals").size(), 1u);
  EXPECT_EQ(triage.at("proposals")[0].at("declare"), json::array({"rays: two-sided"}));
  EXPECT_EQ(triage.at("proposals")[0].at("findings"), index.at("findings")) << "they all go";
}

TEST(Declared, OnTheCommandLineByAPluginOrInAnOlderOneIsTheSame) {
  const TemporaryFolder folder;
  const Ran by_user = run_of("rays", folder / "user", {"--declare", two_sided});
  EXPECT_EQ(by_user.exit_code, 0) << by_user.out << by_user.err;
  EXPECT_NE(by_user.out.find("rays declares for moving_point_triangle: two-sided (\"Both sides count.\")\n"),
            std::string::npos)
      << by_user.out;
  const json index = index_in(folder / "user");
  EXPECT_EQ(complaints(index, "run.schema.json"), "");
  EXPECT_EQ(index.at("declared").dump(),
            R"({"rays":{"moving_point_triangle":[{"convention":"two-sided","sentence":"Both sides count."}]}})");
  for (const char* plugin : {"rays_declare", "rays_declare_in_version_2"}) {
    const Ran ran = run_of(plugin, folder / plugin);
    EXPECT_EQ(ran.exit_code, 0) << plugin << ran.out << ran.err;
    EXPECT_EQ(index_in(folder / plugin).at("tallies"), index.at("tallies")) << plugin;
  }
}

TEST(Declared, AMistakeIsFoundAndReplayedUnderTheSameConvention) {
  const TemporaryFolder folder;
  const Ran ran = run_of("rays_planted", folder / "r", {"--declare", two_sided});
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  const json index = index_in(folder / "r");
  EXPECT_EQ(faults_in(index), std::set<std::string>{"wrong time"});
  const fs::path file = folder / "r" / index.at("reports").at(0).at("file").get<std::string>();
  const json report = json::parse(read_file(file));
  EXPECT_EQ(complaints(report, "report.schema.json"), "");
  EXPECT_EQ(report.at("declared"), json::parse(R"([{"convention": "two-sided", "sentence": "Both sides count."}])"));
  EXPECT_NE(report.at("explanation").get<std::string>().find("It declares: two-sided (\"Both sides count.\")"),
            std::string::npos);
  EXPECT_TRUE(report.at("truth").at("yes"));
  for (const char* command : {"replay", "show"}) {
    const Ran again = nearmiss({command, "--plugin", plugin_file("rays_planted"), "--subject", "rays", file.string()});
    EXPECT_EQ(again.exit_code, 1) << command << again.err;
    EXPECT_NE(again.out.find("wrong time"), std::string::npos) << command << again.out;
    EXPECT_NE(again.out.find("It declares: two-sided"), std::string::npos) << command << again.out;
    EXPECT_NE(again.out.find("Truth: it is a hit"), std::string::npos) << command << again.out;
  }
  const Ran minimised = nearmiss(
      {"minimise", "--plugin", plugin_file("rays_planted"), file.string(), "--out", (folder / "m").string(), "--json"});
  EXPECT_NE(minimised.out.find("two-sided"), std::string::npos) << minimised.out << minimised.err;
  // Without its declaration the same answer is another finding.
  json undeclared = report;
  undeclared.erase("declared");
  write_file(folder / "undeclared.json", undeclared.dump());
  const Ran other = nearmiss({"replay", "--json", "--plugin", plugin_file("rays_planted"), "--subject", "rays",
                              (folder / "undeclared.json").string()});
  EXPECT_EQ(json::parse(other.out).at(0).at("finding").at("disagreement"), "false hit") << other.out;
}

/// A program whose hello declares; it is not asked.
std::string program_that_says(const TemporaryFolder& folder, const std::string& declares) {
  write_file(folder / "hello", R"({"nearmiss": 3, "name": "told", "scalar": "double", "batches": "json", )"
                               R"("offers": [{"query": "moving_point_box", "declares": )" +
                                   declares + "}]}\n");
  write_file(folder / "program", "cat '" + (folder / "hello").string() + "' >&4; cat <&3 >/dev/null\n");
  return "sh " + (folder / "program").string();
}

TEST(Declared, ByAProgram) {
  const TemporaryFolder folder;
  const std::string program = program_that_says(
      folder, R"(["start in contact is a miss", {"convention": "normal reversed", "sentence": "Into the box."}])");
  const Ran ran = nearmiss({"list", "--json", "--command", program});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const json listed = json::parse(ran.out);
  for (const json& q : listed.at("queries")) {
    if (q.at("query") != "moving_point_box") continue;
    EXPECT_EQ(
        q.at("declared").at("told").dump(),
        R"([{"convention":"start in contact is a miss"},{"convention":"normal reversed","sentence":"Into the box."}])");
  }
  const Ran why = nearmiss({"list", "--why", "--command", program});
  EXPECT_NE(why.out.find("start in contact is a miss, normal reversed (\"Into the box.\")"), std::string::npos);
}

TEST(Declared, WhatIsWrongIsToldInOneLine) {
  const TemporaryFolder folder;
  const auto refused = [](const Ran& ran, const char* says) {
    EXPECT_EQ(ran.exit_code, 2) << says;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_NE(ran.err.find(says), std::string::npos) << ran.err;
  };
  const std::vector<std::pair<const char*, const char*>> on_the_command_line{
      {"rays: both-sided", "those that exist: two-sided, normal of the front, "},
      {"ray: two-sided", "unknown subject 'ray'"},
      {"rays moving_point_triangles: two-sided", "moving_point_triangles"},
      {"rays moving_point_triangle: center in place of the contact", "has no effect on moving_point_triangle"},
      {"rays moving_point_plane: two-sided", "rays does not offer moving_point_plane"},
      {"rays: center in place of the contact", "has no effect on a query that rays offers"},
      {"rays", "it must be \"SUBJECT: CONVENTION\""},
  };
  for (const auto& [text, says] : on_the_command_line)
    refused(nearmiss({"list", "--plugin", plugin_file("rays"), "--declare", text}), says);
  refused(nearmiss({"list", "--plugin", plugin_file("rays"), "--declare", "rays: start in contact is a hit",
                    "--declare", "rays: start in contact is a miss"}),
          "contradicts 'start in contact is a hit'");
  refused(nearmiss({"list", "--plugin", plugin_file("rays_declare_unknown")}),
          "it declares 'both sides', which is none");
  refused(nearmiss({"list", "--plugin", plugin_file("rays_declare_nothing")}),
          "has no effect on a query that it offers");
  refused(nearmiss({"list", "--plugin", plugin_file("rays_declare_both")}), "which contradict each other");
  refused(nearmiss({"list", "--command", program_that_says(folder, R"(["two-sided"])")}), "where it has no effect");
  refused(nearmiss({"list", "--command", program_that_says(folder, R"(["both"])")}), "which is none of two-sided, ");
  refused(nearmiss({"list", "--command", program_that_says(folder, "[1]")}), "neither a text nor an object");
}

/// The adapter of a library that misses what it starts in.
struct Declaring {
  using Number = double;
  static std::string version() { return "1"; }
  static collide::Decision<double> answer(const inputs::sphere_sphere_overlap<double>&) { return {}; }
  template <class Q>
  static std::vector<Declaration> declares() {
    return {{Convention::strict_touch, "Balls that touch do not overlap."}};
  }
};

TEST(Declared, ByAnAdapter) {
  const Subject s = bind_one<Declaring, inputs::sphere_sphere_overlap<double>>("strict", "sphere_sphere_overlap");
  ASSERT_EQ(s.declared_for("sphere_sphere_overlap").size(), 1u);
  EXPECT_TRUE(s.standard_for("sphere_sphere_overlap").declared.has(Convention::strict_touch));
  EXPECT_TRUE(s.standard_for("sphere_box_overlap").declared.empty());
}

TEST(Declared, AReportWithABadConventionIsRefused) {
  const json report{{"finding", json::object()},
                    {"query", "moving_point_triangle"},
                    {"subject", {{"name", "rays"}}},
                    {"measure", nullptr},
                    {"declared", json::array({{{"convention", "both"}}})}};
  EXPECT_THROW(measure_of(report, "r.json"), BadInput);
}

}  // namespace
}  // namespace nearmiss
