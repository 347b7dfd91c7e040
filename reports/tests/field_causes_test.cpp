/// The set of findings of real libraries with known causes, corpus/field-causes: its form, and that each stored answer
/// is a finding.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <vector>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;

std::vector<json> lines_of(const std::string& file) {
  std::istringstream text(read_file(source_folder() + "/corpus/field-causes/" + file));
  std::vector<json> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(json::parse(line));
  return lines;
}

TEST(FieldCauses, FollowTheSchema) {
  for (const std::string set : {"train", "test"}) {
    std::map<std::string, int> rows_of;
    for (const json& bug : lines_of(set + "/bugs.jsonl")) {
      EXPECT_EQ(complaints(bug, "field-causes.schema.json"), "") << bug.at("id");
      EXPECT_TRUE(rows_of.emplace(bug.at("id"), 0).second) << bug.at("id") << " is there twice";
    }
    for (const json& row : lines_of(set + "/rows.jsonl")) {
      EXPECT_EQ(complaints(row, "field-causes.schema.json"), "") << row.at("bug");
      const auto bug = rows_of.find(row.at("bug"));
      if (bug == rows_of.end()) {
        ADD_FAILURE() << row.at("bug") << " is no bug of this set";
      } else {
        ++bug->second;
      }
    }
    for (const auto& [bug, rows] : rows_of) EXPECT_GT(rows, 0) << bug << " has no row";
  }
}

struct CaseOfRow {
  json row, inputs;
};

/// The cases of each subject, without those in which it broke.
std::map<std::string, std::vector<CaseOfRow>> cases_by_subject() {
  std::map<std::string, std::vector<CaseOfRow>> cases;
  for (const std::string set : {"train", "test"}) {
    for (const json& row : lines_of(set + "/rows.jsonl")) {
      if (row.at("disagreement") == "broke") continue;
      for (const json& c : row.at("cases")) cases[row.at("subject")].push_back({row, c.at("inputs")});
    }
  }
  return cases;
}

TEST(FieldCauses, EachStoredAnswerIsAFinding) {
  if (example_py().empty()) GTEST_SKIP() << "there is no Python";
  if (is_sanitized) GTEST_SKIP() << "it examines the set, not the code";
  const std::string python = example_py().substr(0, example_py().find(' '));
  for (const auto& [subject, cases] : cases_by_subject()) {
    const std::set<std::string> of_floats{"bullet-float", "embree",       "jolt",    "jolt-strict",
                                          "physx",        "physx-strict", "rapier3d"};
    const bool in_float = of_floats.contains(subject);
    const std::string scalar = in_float ? "float" : "double";
    const TemporaryFolder folder;
    std::vector<std::string> arguments{
        "replay",    "--json",
        "--measure", "1e-4",
        "--subject", "stored",
        "--command", fmt::format("{} {}/corpus/field-causes/answers {} {}", python, source_folder(), scalar, subject)};
    for (const CaseOfRow& c : cases) {
      const auto file = folder / (std::to_string(arguments.size()) + ".json");
      write_file(file, json{{"query", c.row.at("query")}, {"scalar", scalar}, {"inputs", c.inputs}}.dump());
      arguments.push_back(file.string());
    }
    const Ran ran = nearmiss(arguments);
    ASSERT_EQ(ran.exit_code, 1) << subject << ": " << ran.err;
    const json reports = json::parse(ran.out);
    ASSERT_EQ(reports.size(), cases.size()) << subject;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      EXPECT_EQ(reports[i].at("finding").at("disagreement"), cases[i].row.at("disagreement"))
          << subject << ", " << cases[i].row.at("bug") << ": " << cases[i].inputs;
    }
  }
}

}  // namespace
}  // namespace nearmiss
