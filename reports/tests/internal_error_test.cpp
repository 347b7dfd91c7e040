/// Every engine detects a judge that contradicts itself: it counts no finding and exits with code 3.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "corpus/storage/codec.hpp"
#include "oracles/confirmed.hpp"
#include "reports/engine/replay.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* contradiction =
    "collide-fast-double: the judge contradicts itself about sphere_sphere_overlap: at first \"";

/// The command line with tests/contradicting_oracle.cpp in it.
Ran contradicting(std::vector<std::string> arguments, const TemporaryFolder& folder) {
  for (const char* more :
       {"--query", "sphere_sphere_overlap", "--subject", "collide-fast-double", "--seed", "1", "--out"}) {
    arguments.emplace_back(more);
  }
  arguments.push_back((folder / "r").string());
  return run_program(contradicting_program(), arguments);
}

/// Checks the file of the engine: it is valid, and every kept case is a file with both findings.
void check(const TemporaryFolder& folder, const json& written, const std::string& schema) {
  EXPECT_EQ(complaints(written, schema), "");
  const json& errors = written.at("internal_errors");
  ASSERT_GT(errors.at("count"), 0u);
  ASSERT_EQ(errors.at("kept").size(), std::min<std::size_t>(errors.at("count").get<std::size_t>(), 8));
  for (const json& kept : errors.at("kept")) {
    EXPECT_NE(kept.at("words").get<std::string>().find("; in full \"agrees\""), std::string::npos) << kept;
    const Case c = read_case_or_report(folder / "r" / kept.at("file").get<std::string>());
    EXPECT_EQ(c.query->name, "sphere_sphere_overlap");
    EXPECT_GT(c.values[0], 0);
  }
}

std::size_t lines_with(const std::string& what, const std::string& text) {
  std::size_t lines = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++lines;
  return lines;
}

TEST(InternalErrors, EndARunWithBothWordsAndItsFindings) {
  const TemporaryFolder folder;
  const Ran ran = contradicting({"run", "--cases", "300"}, folder);
  EXPECT_EQ(ran.exit_code, InternalError::exit_code) << ran.err;
  EXPECT_EQ(lines_with(contradiction, ran.err), 8u) << ran.err;
  EXPECT_NE(ran.out.find(" internal errors, see "), std::string::npos) << ran.out;
  const json index = json::parse(read_file(folder / "r" / "index.json"));
  check(folder, index, "run.schema.json");
  EXPECT_EQ(index["state"], "finished");
  EXPECT_EQ(index["cases"].get<std::uint64_t>() + index["internal_errors"]["count"].get<std::uint64_t>(), 300u);
  EXPECT_GT(index["findings"], 0u);
  for (const json& r : index["reports"]) {
    EXPECT_LE(read_case_or_report(folder / "r" / r["file"].get<std::string>()).values[0], 0) << r;
  }
}

/// The cases of the run's reports are judged alike; those of the plots are not.
TEST(InternalErrors, AreNamedInAPage) {
  const TemporaryFolder folder;
  ASSERT_EQ(contradicting({"run", "--cases", "300"}, folder).exit_code, InternalError::exit_code);
  const Ran ran = run_program(contradicting_program(), {"render", (folder / "r").string()});
  if (ran.err.find("this build writes no pages") != std::string::npos) GTEST_SKIP() << ran.err;
  EXPECT_EQ(ran.exit_code, InternalError::exit_code) << ran.err;
  EXPECT_NE(read_file(folder / "r" / "index.html").find("internal error: "), std::string::npos);
}

TEST(InternalErrors, EndRelationsAndExtremes) {
  const TemporaryFolder related, swept;
  const Ran relations = contradicting({"relations", "--cases", "5000"}, related);
  EXPECT_EQ(relations.exit_code, InternalError::exit_code) << relations.err;
  EXPECT_NE(relations.err.find(contradiction), std::string::npos) << relations.err;
  check(related, json::parse(read_file(related / "r" / "relations.json")), "relations.schema.json");
  const Ran extremes = contradicting({"extremes", "--cases", "1"}, swept);
  EXPECT_EQ(extremes.exit_code, InternalError::exit_code) << extremes.err;
  check(swept, json::parse(read_file(swept / "r" / "extremes.json")), "extremes.schema.json");
}

/// The night is interrupted once it has met an internal error, whenever that is. The internal error decides the exit
/// code.
TEST(InternalErrors, EndANight) {
  constexpr double until_ended = 60, until_error = 600;  // seconds; a busy machine under a sanitizer takes many
  const TemporaryFolder folder;
  Started night(contradicting_program(),
                {"nightly", "--no-triage", "--minutes", "60", "--out", (folder / "r").string()}, {});
  std::optional<Ran> ran;
  for (double waited = 0; waited < until_error && !ran; waited += 0.2) {
    if (fs::exists(folder / "r/internal-errors")) break;
    ran = night.wait(0.2);
  }
  ASSERT_FALSE(ran.has_value()) << ran->out << ran->err;
  night.send(SIGTERM);
  ran = night.wait(until_ended);
  ASSERT_TRUE(ran.has_value()) << "it goes on";
  EXPECT_EQ(ran->exit_code, InternalError::exit_code) << ran->err;
  EXPECT_NE(ran->err.find("the judge contradicts itself about sphere_sphere_overlap"), std::string::npos) << ran->err;
}

TEST(InternalErrors, ReplayAgain) {
  const TemporaryFolder folder;
  contradicting({"run", "--cases", "20"}, folder);
  const json index = json::parse(read_file(folder / "r" / "index.json"));
  const std::string file = (folder / "r" / index["internal_errors"]["kept"][0]["file"].get<std::string>()).string();
  const Ran again = run_program(contradicting_program(), {"replay", "--subject", "collide-fast-double", file});
  EXPECT_EQ(again.exit_code, InternalError::exit_code);
  EXPECT_EQ(lines_with("\n", again.err), 1u) << again.err;
  EXPECT_NE(again.err.find("at first \""), std::string::npos) << again.err;
  EXPECT_EQ(nearmiss({"replay", "--subject", "collide-fast-double", file}).exit_code, 0);
}

/// The internal error of explain is about another case than the given one. The stored file has that case.
TEST(InternalErrors, EndTheWorkForTheirSubjectAlone) {
  const TemporaryFolder folder;
  for (const auto& [command, x] : {std::pair("explain", "-1"), std::pair("minimise", "1")}) {
    const std::string question =
        folder.file("case.json", fmt::format(R"({{"query": "sphere_sphere_overlap", "scalar": "double", "inputs": {{
                          "sphere1": {{"center": [{}, 0, 0], "radius": 1}},
                          "sphere2": {{"center": [0, 0, 0], "radius": 1}}}}}})",
                                             x));
    const fs::path out = folder / command;
    const Ran ran = run_program(contradicting_program(), {command, "--subject", "collide-fast-double", "--subject",
                                                          "collide-accurate-double", "--out", out.string(), question});
    EXPECT_EQ(ran.exit_code, InternalError::exit_code) << ran.out << ran.err;
    for (const char* subject : {"collide-fast-double", "collide-accurate-double"}) {
      EXPECT_NE(ran.err.find(std::string(subject) + ": the judge contradicts itself"), std::string::npos) << ran.err;
    }
    ASSERT_TRUE(fs::exists(out / "internal-errors")) << ran.err;
    for (const auto& file : fs::directory_iterator(out / "internal-errors"))
      EXPECT_GT(read_case_or_report(file.path()).values[0], 0) << file;
  }
}

TEST(InternalErrors, AreToldInTheManuals) {
  for (const char* command :
       {"run", "nightly", "relations", "extremes", "sweep", "replay", "minimise", "explain", "promote", "import"}) {
    EXPECT_NE(nearmiss({"help", command}).out.find("An internal error: the judge contradicts itself."),
              std::string::npos)
        << command;
  }
}

}  // namespace
}  // namespace nearmiss
