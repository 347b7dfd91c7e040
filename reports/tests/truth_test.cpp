/// 'nearmiss truth' answers lines of cases with lines of exact answers, as its manual and docs/truth.md say.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "corpus/storage/store.hpp"
#include "oracles/judge.hpp"
#include "reports/findings/report.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;

std::vector<json> records_of(const std::string& text) {
  std::vector<json> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(json::parse(line));
  return lines;
}

/// The answers to the lines of a file.
std::vector<json> truths(const std::string& cases, std::vector<std::string> options = {}) {
  const TemporaryFolder folder;
  options.insert(options.begin(), "truth");
  options.push_back(folder.file("cases.jsonl", cases));
  const Ran ran = nearmiss(options);
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  return records_of(ran.out);
}

/// Runs a script of bash in which $nearmiss is the command line.
Ran in_bash(const std::string& script) {
  return run_program("bash", {"-c", script}, {"nearmiss=" + nearmiss_program()});
}

/// A case with its numbers in a row.
std::string case_line(const std::string& numbers, const std::string& query = "sphere_sphere_penetration") {
  return R"({"query": ")" + query + R"(", "values": [)" + numbers + "]}\n";
}
const std::string touching = case_line("0, 0, 0, 1, 2, 0, 0, 1", "sphere_sphere_overlap");
const std::string apart = case_line("0, 0, 0, 1, 3, 0, 0, 1", "sphere_sphere_overlap");

/// The depth of two points at the distance of (x, y, z).
std::string depth_of_points(const std::string& x, const std::string& y, const std::string& z, int digits) {
  const std::vector<json> t =
      truths(case_line(fmt::format("0, 0, 0, 0, {}, {}, {}, 0", x, y, z)), {"--digits", std::to_string(digits)});
  return t.at(0).at("alternatives").at(0).at("decimals").at("depth");
}

TEST(Truth, AnswersEveryStoredCaseInItsPlace) {
  std::string cases;
  std::vector<Case> asked;
  for (const Query& q : catalogue()) {
    for (const StoredCase& s : stored_cases(q)) {
      asked.push_back(s.question);
      cases += case_to_json(s.question).dump() + "\n";
    }
  }
  ASSERT_GT(asked.size(), 500u);
  const std::vector<json> answers = truths(cases, {"--jobs", "3"});
  ASSERT_EQ(answers.size(), asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const json expected = json::parse(truth_line_to_json(asked[i], truth_of(asked[i]), false).dump());
    EXPECT_EQ(answers[i], expected) << case_to_json(asked[i]).dump();
    EXPECT_EQ(complaints(answers[i], "truth.schema.json"), "") << answers[i].dump();
  }
}

TEST(Truth, KeepsTheOrderOfSlowAndQuickCases) {
  const std::string slow =
      case_line("0, 0, 0, 1, 2, 3, 1, 2, 3, 4,  3, 1, 2, 1, 1, 1, 4, 3, 2, 1, -1", "box_box_overlap");
  std::string cases;
  std::vector<std::string> asked;
  for (const std::string& line : {slow, touching, slow, apart}) {  // each 100 KiB: more than is read at once
    for (std::size_t bytes = 0; bytes < 100'000; bytes += line.size()) {
      cases += line;
      asked.push_back(line == slow ? "box_box_overlap" : "sphere_sphere_overlap");
    }
  }
  const std::vector<json> answers = truths(cases, {"--jobs", "3"});
  ASSERT_EQ(answers.size(), asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i) ASSERT_EQ(answers[i].at("query"), asked[i]) << i;
}

TEST(Truth, HasTheEnclosuresThatReportsHave) {
  const auto definitions = [](const char* file) {
    return json::parse(read_file(source_folder() + "/reports/" + file)).at("definitions");
  };
  const json own = definitions("truth.schema.json"), of_reports = definitions("report.schema.json");
  for (const char* name : {"number", "enclosure", "nested_enclosures"}) EXPECT_EQ(own.at(name), of_reports.at(name));
  EXPECT_EQ(own.at("alternative").at("properties").at("normal_cone"),
            of_reports.at("alternative").at("properties").at("normal_cone"));
}

TEST(Truth, TellsTheMarginInEpsilonOfTheScalar) {
  const std::string in_float = R"({"query": "sphere_sphere_overlap", "scalar": "float", "values": [0,0,0,1,3,0,0,1]})";
  const std::vector<json> t = truths(touching + apart + in_float);
  EXPECT_TRUE(t.at(0).at("yes"));
  EXPECT_EQ(t.at(0).at("margin").at("at_least_epsilon"), 0) << "a touch";
  EXPECT_FALSE(t.at(1).at("yes"));
  // The gap of 1 closes when the centers move by 1/4 and the radii grow by 1/4: by 1/4 / 3 of the largest center.
  for (const auto& [line, scalar, epsilon] : {std::tuple(1, "double", 0x1p-53), std::tuple(2, "float", 0x1p-24)}) {
    EXPECT_EQ(t.at(line).at("scalar"), scalar);
    const json& margin = t.at(line).at("margin");
    EXPECT_EQ(margin.at("epsilon"), epsilon);
    EXPECT_EQ(margin.at("relative"), margin.at("at_least_epsilon").get<double>() * epsilon);
    EXPECT_GE(margin.at("relative"), 1 / 16.0);
    EXPECT_LE(margin.at("relative"), 1 / 4.0);
  }
  EXPECT_EQ(truths(apart, {"--scalar", "float"}).at(0).at("margin"), t.at(2).at("margin"));
}

TEST(Truth, HasEveryRightAnswer) {
  // The center is in the middle of a cube: the sphere leaves it by any face.
  const std::vector<json> t =
      truths(case_line("0, 0, 0, 1,  0, 0, 0,  2, 2, 2,  0, 0, 0, 1", "sphere_box_penetration"));
  EXPECT_EQ(t.at(0).at("alternatives").size(), 6u) << t.at(0).dump(2);
  for (const json& a : t.at(0).at("alternatives")) {
    EXPECT_LE(a.at("values").at("depth").at(0), 3);
    EXPECT_GE(a.at("values").at("depth").at(1), 3);
  }
}

TEST(Truth, RoundsDecimalsCorrectly) {
  EXPECT_EQ(depth_of_points("1", "1", "0", 50), "-1.4142135623730950488016887242096980785696718753769");
  EXPECT_EQ(depth_of_points("1", "1", "0", 1), "-1");
  EXPECT_EQ(depth_of_points("1", "1", "1", 30), "-1.73205080756887729352744634151");
  EXPECT_EQ(depth_of_points("1e20", "1e20", "0", 21), "-141421356237309504880") << "to the last digit before the point";
  EXPECT_EQ(depth_of_points("1e-5", "0", "0", 30), "-1.00000000000000008180305391403e-05")
      << "the number that the decimal means";
  EXPECT_EQ(depth_of_points("3", "4", "0", 30), "-5") << "a root that is a whole number";
  EXPECT_EQ(depth_of_points("0.125", "0", "0", 2), "-0.12") << "half way: the even one";
  EXPECT_EQ(depth_of_points("0.375", "0", "0", 2), "-0.38");
  EXPECT_EQ(depth_of_points("0.375", "0.5", "0", 2), "-0.62") << "half way, by a root";
  EXPECT_EQ(depth_of_points("1.125", "1.5", "0", 3), "-1.88");
  EXPECT_EQ(depth_of_points("0.1", "0", "0", 16), "-0.1000000000000000") << "rounded, so all digits are there";
  EXPECT_EQ(depth_of_points("0.5", "0", "0", 9), "-0.5") << "exact, so these are all";
  EXPECT_EQ(depth_of_points("0", "0", "0", 9), "0");
  EXPECT_EQ(depth_of_points("1", "1", "0", 1000).size(), 1002u);
  const json t = truths(case_line("0, 0, 0, 1, 1, 1, 0, 1"), {"--digits", "25"}).at(0);
  EXPECT_EQ(complaints(t, "truth.schema.json"), "") << t.dump();
  const json& right = t.at("alternatives").at(0);
  EXPECT_EQ(right.at("decimals").at("normal"),
            json::array({"0.7071067811865475244008444", "0.7071067811865475244008444", "0"}));
  EXPECT_LT(right.at("values").at("normal").at(0).at(0), 0.70710678118654755);
}

TEST(Truth, AnswersALineBeforeItAwaitsTheNext) {
  const Ran ran = in_bash("coproc $nearmiss truth; for line in '" + touching.substr(0, touching.size() - 1) + "' '" +
                          apart.substr(0, apart.size() - 1) +
                          "'; do echo \"$line\" >&${COPROC[1]}; IFS= read -r -t 60 -u ${COPROC[0]} answer || exit 3; "
                          "echo \"$answer\"; done");
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  const std::vector<json> t = records_of(ran.out);
  ASSERT_EQ(t.size(), 2u);
  EXPECT_TRUE(t[0].at("yes"));
  EXPECT_FALSE(t[1].at("yes"));
}

TEST(Truth, EndsAtABadLineAfterTheAnswersBeforeIt) {
  const TemporaryFolder folder;
  const std::pair<std::string, std::vector<std::string>> bad_lines[] = {
      {"{\"query\": ", {"each line must hold one whole case"}},
      {"[1, 2]", {"the case is [1,2]", "an object"}},
      {case_line("0, 0, 0, -1, 1, 0, 0, 1"), {"inputs.sphere1.radius", "-1"}},
      {case_line("0, 0, 0, 1, 1, 0, 0"), {"values has 7 numbers", "8"}},
      {case_line("0", "sphere_sphere_overlaps"), {"unknown query", "did you mean sphere_sphere_overlap"}},
      {R"({"query": "sphere_sphere_overlap", "inputs": [0, 0, 0, 1, 1, 0, 0, 1]})", {"inputs is", "\"values\""}},
      {R"({"query": "sphere_sphere_overlap", "scalar": "half", "values": []})", {"scalar is \"half\""}},
      {std::string(2u << 20, '['), {"longer than 1 MiB"}},
  };
  for (const auto& [bad, says] : bad_lines) {
    const std::string file = folder.file("bad.jsonl", fmt::format("\n{}\n{}{}\n{}", touching, apart, bad, apart));
    const Ran ran = nearmiss({"truth", "--jobs", "2", file});
    EXPECT_EQ(ran.exit_code, 2) << bad.substr(0, 80);
    EXPECT_EQ(records_of(ran.out).size(), 2u) << bad.substr(0, 80);
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_NE(ran.err.find(file + ":5: "), std::string::npos) << ran.err;
    for (const std::string& part : says) EXPECT_NE(ran.err.find(part), std::string::npos) << ran.err;
  }
}

TEST(Truth, EndsAtABadLineOfAProgramThatGoesOn) {
  const Ran ran =
      in_bash("coproc timeout 60 $nearmiss truth --jobs 4; exec 5>&${COPROC[1]}; echo '[]' >&5; wait $COPROC_PID");
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.err.find("standard input:1: "), std::string::npos) << ran.err;
}

TEST(Truth, ReadsFilesInTheirOrderAndStandardInput) {
  const TemporaryFolder folder;
  const std::string first =
      folder.file("first", "\xEF\xBB\xBF" + touching + "\r\n" + apart.substr(0, apart.size() - 1));
  const std::string second = folder.file("second", "");
  const Ran ran = run_program("bash", {"-c", R"(printf %s "$1" | "$2" truth "$3" "$4" - "$3")", "bash", touching,
                                       nearmiss_program(), first, second});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  std::string decisions;
  for (const json& t : records_of(ran.out)) decisions += t.at("yes") ? 'y' : 'n';
  EXPECT_EQ(decisions, "ynyyn");
  const Ran missing = nearmiss({"truth", first, (folder / "third").string()});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_EQ(missing.out, "") << "all files are opened before the first answer";
  EXPECT_NE(missing.err.find("third: cannot be read"), std::string::npos) << missing.err;
}

TEST(Truth, EndsQuietlyWithoutAReader) {
  const TemporaryFolder folder;
  std::string many;
  for (int i = 0; i < 5000; ++i) many += apart;
  const Ran ran = run_program("bash", {"-c", R"("$1" truth "$2" | head -n 1; echo ${PIPESTATUS[0]})", "bash",
                                       nearmiss_program(), folder.file("many", many)});
  EXPECT_NE(ran.out.find("\n141\n"), std::string::npos) << ran.out;  // of SIGPIPE
  EXPECT_EQ(ran.err, "");
}

TEST(Truth, SaysHowManyDecimalsWereRounded) {
  const TemporaryFolder folder;
  const std::string line =
      R"({"query": "sphere_sphere_overlap", "scalar": "float", "values": [0.1, 0.2, 0, 1, 3, 0, 0, 1]})";
  std::string many;
  for (int i = 0; i < 1000; ++i) many += line + "\n";
  const std::string file = folder.file("cases", many);
  const Ran ran = nearmiss({"truth", "--jobs", "4", file});
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_NE(ran.err.find("note: 2000 decimals"), std::string::npos) << ran.err;
  const Ran exact = nearmiss({"truth", "--exact", file});
  EXPECT_EQ(exact.exit_code, 2);
  EXPECT_NE(exact.err.find("exactly a float"), std::string::npos) << exact.err;
}

/// The examples of docs/truth.md.
struct Example {
  std::string interpreter, file, right, wrong;  ///< the text that is wrong with `wrong` in place of `right`
};
void PrintTo(const Example& e, std::ostream* out) { *out << e.file; }

class TruthExample : public testing::TestWithParam<Example> {};

TEST_P(TruthExample, PassesAndFailsWithAMistake) {
  const auto& [interpreter, file, right, wrong] = GetParam();
  if (interpreter.empty()) GTEST_SKIP() << "this system has nothing to run it";
  const std::string example = source_folder() + "/docs/example-truth/" + file;
  const Ran ran = run_program(interpreter, {example, nearmiss_program()});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_TRUE(ran.out.starts_with("1000 ")) << ran.out;
  std::string text = read_file(example);
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 20);
  const std::size_t at = text.find(right);
  ASSERT_NE(at, std::string::npos);
  const TemporaryFolder folder;
  const Ran mistaken =
      run_program(interpreter, {folder.file(file, text.replace(at, right.size(), wrong)), nearmiss_program()});
  EXPECT_EQ(mistaken.exit_code, 1);
  EXPECT_NE(mistaken.err.find("exactly, they "), std::string::npos) << mistaken.err;
}

INSTANTIATE_TEST_SUITE_P(Of, TruthExample,
                         testing::Values(Example{python(), "balls.py", "- math.dist", "+ math.dist"},
                                         Example{node(), "balls.js", "<= float(r * r)", "<= float(r)"}),
                         [](const auto& of) { return of.param.file.substr(of.param.file.find('.') + 1); });

}  // namespace
}  // namespace nearmiss
