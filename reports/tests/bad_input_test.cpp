/// Bad input gives exit code 2 and one line on standard error with the error and its reason, and writes no file.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "impl/catalogue/query.hpp"
#include "impl/subject/subject.hpp"
#include "reports/tests/program.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;

/// A case that is valid where `center`, `radius` and `query` are.
std::string case_text(const std::string& center, const std::string& radius,
                      const std::string& query = "sphere_box_penetration", const std::string& scalar = "double") {
  return R"({"query": ")" + query + R"(", "scalar": ")" + scalar + R"(", "inputs": {"sphere": {"center": )" + center +
         R"(, "radius": )" + radius + R"(}, "box": {"center": [0, 0, 0], "half": [1, 1, 1], )" +
         R"("orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}}})";
}

struct Bad {
  const char* name;
  std::vector<std::string> arguments;  ///< OUT becomes a folder that does not exist, FILE a file with `text`
  std::vector<std::string> says;       ///< each must be in the line
  std::string text = "";               ///< LONG becomes five million times the letter or digit behind it
};
void PrintTo(const Bad& b, std::ostream* out) { *out << b.name; }

const Bad bad_command_lines[] = {
    {"no_command", {}, {"command"}},
    {"unknown_command", {"rum"}, {"unknown command 'rum'", "run"}},
    {"unknown_option", {"run", "--frobnicate", "--out", "OUT"}, {"--frobnicate"}},
    {"mistyped_option", {"run", "--cas", "5", "--out", "OUT"}, {"unknown option '--cas'", "did you mean --cases?"}},
    {"subject_in_capitals", {"run", "--subject", "COLLIDE-FAST-FLOAT", "--out", "OUT"}, {"collide-fast-float"}},
    {"value_of_a_flag", {"run", "--by-class=7", "--out", "OUT"}, {"by-class"}},
    {"output_without_a_name", {"run", "--cases", "5", "--out", ""}, {"--out", "empty"}},
    {"relations_without_a_name", {"relations", "--cases", "5", "--out", ""}, {"--out", "empty"}},
    {"nightly_without_a_name", {"nightly", "--minutes", "0.01", "--out", ""}, {"--out", "empty"}},
    {"surplus_word", {"run", "fast", "--out", "OUT"}, {"fast"}},
    {"extremes_without_cases", {"extremes", "--cases", "0", "--out", "OUT"}, {"--cases", "0"}},
    {"extremes_of_an_unknown_query", {"extremes", "--query", "moving_box", "--out", "OUT"}, {"--query", "moving_box"}},
    {"sweep_of_nothing", {"sweep", "--number", "x", "--out", "OUT"}, {"--query or --case is missing"}},
    {"sweep_without_a_number", {"sweep", "--query", "sphere_sphere_overlap", "--out", "OUT"}, {"--number is missing"}},
    {"sweep_of_an_unknown_number",
     {"sweep", "--query", "sphere_sphere_overlap", "--number", "radius", "--out", "OUT"},
     {"no number 'radius'", "sphere1.radius"}},
    {"sweep_of_an_index",
     {"sweep", "--query", "point_in_triangle", "--number", "axis", "--out", "OUT"},
     {"axis of point_in_triangle", "whole number"}},
    {"sweep_without_a_decision",
     {"sweep", "--query", "closest_point_segment", "--number", "point.x", "--out", "OUT"},
     {"closest_point_segment decides nothing"}},
    {"sweep_of_double",
     {"sweep", "--query", "sphere_sphere_overlap", "--number", "sphere1.radius", "--subject", "collide-fast-double",
      "--out", "OUT"},
     {"collide-fast-double", "double"}},
    {"sweep_of_a_plugin",
     {"sweep", "--query", "sphere_sphere_overlap", "--number", "sphere1.radius", "--plugin", "x.so", "--out", "OUT"},
     {"unknown option '--plugin'"}},
    {"sweep_to_infinity",
     {"sweep", "--query", "sphere_sphere_overlap", "--number", "sphere1.radius", "--to", "1e40", "--out", "OUT"},
     {"--to", "'1e40' is not a finite float"}},
    {"sweep_of_no_float",
     {"sweep", "--query", "sphere_sphere_overlap", "--number", "sphere1.radius", "--from", "2", "--to", "1", "--out",
      "OUT"},
     {"--from is above --to"}},
    {"sweep_of_a_file_of_double",
     {"sweep", "--case", "FILE", "--number", "sphere.radius", "--out", "OUT"},
     {"FILE", "float cannot hold"},
     case_text("[0.1, 0, 0]", "1")},
    {"sweep_of_another_query",
     {"sweep", "--case", "FILE", "--query", "sphere_sphere_overlap", "--number", "sphere.radius", "--out", "OUT"},
     {"FILE", "sphere_box_penetration", "sphere_sphere_overlap"},
     case_text("[0, 0, 0]", "1")},
    {"state_of_a_sweep", {"replay", "FILE"}, {"FILE", "state of a sweep"}, R"({"schema": 1, "done": []})"},
    {"unknown_relation", {"relations", "--relation", "swaped", "--out", "OUT"}, {"--relation", "swaped", "swapped"}},
    {"unknown_query",
     {"run", "--query", "moving_spere_box", "--out", "OUT"},
     {"--query", "moving_spere_box", "moving_sphere_box"}},
    {"hopeless_query", {"run", "--query", "zzz", "--out", "OUT"}, {"zzz", "nearmiss list"}},
    {"unknown_subject",
     {"run", "--subject", "colide-fast-float", "--out", "OUT"},
     {"--subject", "colide-fast-float", "collide-fast-float"}},
    {"negative_cases", {"run", "--cases", "-5", "--out", "OUT"}, {"--cases", "-5"}},
    {"zero_cases", {"run", "--cases", "0", "--out", "OUT"}, {"--cases", "'0'"}},
    {"cases_in_words", {"run", "--cases", "many", "--out", "OUT"}, {"--cases", "many"}},
    {"fractional_cases", {"run", "--cases", "1.5", "--out", "OUT"}, {"--cases", "1.5"}},
    {"too_many_cases",
     {"run", "--cases", "99999999999999999999999", "--out", "OUT"},
     {"--cases", "99999999999999999999999"}},
    {"missing_cases", {"run", "--out", "OUT", "--cases"}, {"--cases"}},
    {"negative_seed", {"run", "--seed", "-1", "--out", "OUT"}, {"--seed", "-1"}},
    {"negative_seconds", {"run", "--seconds", "-1", "--out", "OUT"}, {"--seconds", "-1"}},
    {"seconds_that_are_no_number", {"run", "--seconds", "nan", "--out", "OUT"}, {"--seconds", "nan"}},
    {"cases_and_seconds", {"run", "--cases", "5", "--seconds", "5", "--out", "OUT"}, {"--cases", "--seconds"}},
    {"unwritable_output", {"run", "--cases", "5", "--out", "/dev/null/run"}, {"/dev/null/run"}},
    {"output_is_a_file", {"run", "--cases", "5", "--out", "FILE"}, {"FILE"}},
    {"zero_minutes", {"nightly", "--minutes", "0", "--out", "OUT"}, {"--minutes"}},
    {"unwritable_nightly", {"nightly", "--minutes", "0.01", "--out", "/dev/null/run"}, {"/dev/null/run"}},
    {"no_folder_of_fuzz_targets", {"nightly", "--fuzz-targets", "OUT", "--out", "OUT"}, {"--fuzz-targets"}},
    {"truth_in_no_digits", {"truth", "--digits", "0", "FILE"}, {"--digits", "'0'"}},
    {"truth_in_an_unknown_scalar", {"truth", "--scalar", "half", "FILE"}, {"--scalar", "'half' is no scalar"}},
    {"truth_of_a_missing_file", {"truth", "OUT"}, {"OUT", "cannot be read"}},
    {"truth_of_a_folder", {"truth", "/"}, {"/", "cannot be read"}},
    {"nothing_to_replay", {"replay"}, {"FILE is missing"}},
    {"missing_file", {"replay", "OUT"}, {"OUT"}},
    {"a_folder", {"replay", "/"}, {"/"}},
    {"not_json", {"replay", "FILE"}, {"FILE"}, "{\"query\": "},
    {"empty_file", {"replay", "FILE"}, {"FILE", "is empty"}, ""},
    {"file_without_end", {"replay", "/dev/zero"}, {"/dev/zero", "longer than 256 MiB"}},
    {"an_array", {"replay", "FILE"}, {"FILE"}, "[1, 2]"},
    {"no_query", {"replay", "FILE"}, {"FILE", "query"}, "{\"scalar\": \"double\"}"},
    {"case_of_an_unknown_query", {"replay", "FILE"}, {"FILE", "juggling"}, case_text("[0, 0, 0]", "1", "juggling")},
    {"case_with_nan", {"replay", "FILE"}, {"FILE"}, case_text("[NaN, 0, 0]", "1")},
    {"case_with_nan_in_words", {"replay", "FILE"}, {"FILE", "sphere.center"}, case_text("[\"NaN\", 0, 0]", "1")},
    {"case_beyond_double", {"replay", "FILE"}, {"FILE"}, case_text("[1e999, 0, 0]", "1")},
    {"case_with_a_negative_radius", {"replay", "FILE"}, {"FILE", "sphere.radius", "-1"}, case_text("[0, 0, 0]", "-1")},
    {"case_with_two_coordinates", {"replay", "FILE"}, {"FILE", "sphere.center"}, case_text("[0, 0]", "1")},
    {"case_that_float_cannot_hold",
     {"replay", "--exact", "FILE"},
     {"FILE", "0.1", "exactly a float"},
     case_text("[0.1, 0, 0]", "1", "sphere_box_penetration", "float")},
    {"report_of_another_schema",
     {"replay", "FILE"},
     {"FILE", "schema is 3", "schema 1 to 2"},
     R"({"schema": 3, "finding": {}, )" + case_text("[0, 0, 0]", "1").substr(1)},
    {"report_of_no_schema",
     {"replay", "FILE"},
     {"FILE", "schema is missing"},
     R"({"finding": {}, )" + case_text("[0, 0, 0]", "1").substr(1)},
    {"index_of_a_run", {"replay", "FILE"}, {"FILE", "index of a run"}, R"({"schema": 1, "tallies": []})"},
    {"case_of_a_mistyped_query",
     {"replay", "FILE"},
     {"FILE", "did you mean", "sphere_box_penetration"},
     case_text("[0, 0, 0]", "1", "sphere_box_penetratoin")},
    {"query_with_nul", {"replay", "FILE"}, {"FILE", "x\\x00y"}, case_text("[0, 0, 0]", "1", "x\\u0000y")},
    {"scalar_with_nul",
     {"replay", "FILE"},
     {"FILE", "double\\u0000", "control characters"},
     case_text("[0, 0, 0]", "1", "sphere_box_penetration", "double\\u0000")},
    {"name_with_nul", {"replay", "FILE"}, {"FILE", "a\\u0000b", "control characters"}, "{\"a\\u0000b\": 1}"},
    {"long_query", {"replay", "FILE"}, {"FILE", "unknown query"}, case_text("[]", "1", "LONGx")},
    {"long_name", {"replay", "FILE"}, {"FILE", "is unknown"}, R"({"LONGx": 1})"},
    {"long_number", {"replay", "FILE"}, {"FILE"}, R"({"query": LONG9})"},
    {"empty_benchmark", {"import", "nyu-ccd", "FILE"}, {"no file holds a query"}, ""},
    {"second_file_is_malformed", {"replay", "CASE", "FILE"}, {"FILE"}, "{}"},
    {"unknown_format", {"import", "bullet", "FILE", "--out", "OUT"}, {"bullet", "nyu-ccd"}},
    {"missing_benchmark", {"import", "nyu-ccd", "OUT"}, {"OUT"}},
    {"malformed_benchmark", {"import", "nyu-ccd", "FILE", "--out", "OUT"}, {"FILE", "1"}, "1,2,3\n"},
    {"unwritable_cases", {"import", "nyu-ccd", "FILE", "--out", "/dev/null/x"}, {"/dev/null/x"}},
    {"benchmark_without_end", {"import", "nyu-ccd", "/dev/zero"}, {"/dev/zero:1", "a byte is 0"}},
    {"benchmark_of_one_line",
     {"import", "nyu-ccd", "FILE"},
     {"FILE", ":2: ", "more than 65,536 bytes"},
     "1,1,1,1,2,1,1\n" + std::string(100'000, '1')},
    {"benchmark_in_utf_16", {"import", "nyu-ccd", "FILE"}, {"FILE", ":1: ", "UTF-16"}, "\xFF\xFE\x31\x2C"},
    {"benchmark_with_nul",
     {"import", "nyu-ccd", "FILE"},
     {"FILE", ":1: ", "a byte is 0"},
     std::string("1,1,") + '\0' + "1\n"},
    {"control_characters_and_directions",
     {"run", "--query", "box\x1b[31m\xc2\x9b\xe2\x80\xae", "--out", "OUT"},
     {"box\\x1b[31m\\xc2\\x9b\\u{202e}"}},
    {"bytes_that_are_no_text", {"run", "--query", "box\xff", "--out", "OUT"}, {"box\\xff"}},
    {"misplaced_comma", {"run", "--cases", "1,00", "--out", "OUT"}, {"--cases", "1,00"}},
    {"fraction_of_a_power", {"run", "--cases", "15e-1", "--out", "OUT"}, {"--cases", "15e-1"}},
    {"no_patience", {"run", "--patience", "0", "--out", "OUT"}, {"--patience", "0"}},
    {"empty_command", {"run", "--command", " ", "--out", "OUT"}, {"--command", "empty"}},
    {"command_that_is_not_there",
     {"run", "--command", "/none/of/these --at all", "--out", "OUT"},
     {"/none/of/these --at all", "No such file"}},
    {"plugin_that_is_not_there",
     {"run", "--plugin", "/none/of/these", "--out", "OUT"},
     {"/none/of/these", "no such file"}},
    {"unknown_shell", {"completion", "zsh"}, {"zsh", "bash"}},
    {"unknown_names", {"list", "--names", "cats"}, {"--names", "cats"}},
    {"unknown_help", {"help", "rum"}, {"rum", "run"}},
};

class BadCommandLine : public testing::TestWithParam<Bad> {};

TEST_P(BadCommandLine, SaysWhyInOneLineAndWritesNothing) {
  const Bad& bad = GetParam();
  const TemporaryFolder folder;
  std::string text = bad.text;
  if (const auto at = text.find("LONG"); at != text.npos) text.replace(at, 5, std::string(5'000'000, text[at + 4]));
  const std::string file = folder.file("input", text), good = folder.file("good.json", case_text("[0, 0, 0]", "1"));
  const auto filled = [&](const std::string& word) {
    return word == "OUT" ? (folder / "out").string() : word == "FILE" ? file : word == "CASE" ? good : word;
  };
  std::vector<std::string> arguments;
  for (const std::string& a : bad.arguments) arguments.push_back(filled(a));
  const Ran ran = nearmiss(arguments, {"NEARMISS_RUNS=" + (folder / "runs").string()});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_EQ(ran.out, "");
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  EXPECT_EQ(ran.err.find("nearmiss: "), 0u) << ran.err;
  EXPECT_LT(ran.err.size(), 1100u);
  for (const char c : ran.err) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20) << int(c);
  for (const std::string& part : bad.says) EXPECT_NE(ran.err.find(filled(part)), std::string::npos) << ran.err;
  std::vector<std::string> left;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    const fs::path name = entry.path().filename();
    const bool empty_folder =
        entry.is_directory() && fs::is_empty(entry.path());  // import makes the folder before it reads
    if (name != "input" && name != "good.json" && !empty_folder) left.push_back(name.string());
  }
  EXPECT_TRUE(left.empty()) << left[0];
}

INSTANTIATE_TEST_SUITE_P(Cli, BadCommandLine, testing::ValuesIn(bad_command_lines),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Cli, TakesCountsAsPeopleWriteThem) {
  for (const char* count : {"1000", "1,000", "1e3"}) {
    const TemporaryFolder folder;
    const Ran ran = nearmiss({"run", "--query", "sphere_sphere_overlap", "--subject", "collide-fast-double", "--cases",
                              count, "--out", (folder / "r").string()});
    EXPECT_EQ(ran.exit_code, 0) << count << ran.err;
    EXPECT_TRUE(last_line(ran.out).starts_with("1,000 answers ")) << ran.out;
  }
}

TEST(Cli, RefusesLinksThatLeadNowhere) {
  const TemporaryFolder folder;
  const std::string one = (folder / "one").string(), other = (folder / "other").string();
  fs::create_symlink(one, other);
  fs::create_symlink(other, one);
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"replay", one},
                                                    {"run", "--cases", "1", "--out", one},
                                                    {"run", "--plugin", one},
                                                    {"import", "nyu-ccd", one},
                                                    {"nightly", "--minutes", "0.01", "--out", one + "/r"}}) {
    const Ran ran = nearmiss(arguments);
    EXPECT_EQ(ran.exit_code, 2) << arguments[0];
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_NE(ran.err.find(one), std::string::npos) << ran.err;
  }
}

TEST(Cli, SaysWhyASubjectCannotBeRunOnAQuery) {
  for (const Subject& s : subjects()) {
    for (const Query& q : catalogue()) {
      if (s.offering(q.name).answer != nullptr) continue;
      for (const char* command : {"run", "extremes"}) {
        const Ran ran =
            nearmiss({command, "--subject", s.name, "--query", std::string(q.name), "--out", "/dev/null/x"});
        EXPECT_EQ(ran.exit_code, 2);
        EXPECT_NE(ran.err.find(s.offering(q.name).how), std::string::npos) << ran.err;
      }
      return;
    }
  }
  GTEST_SKIP() << "every subject of this build offers every query";
}

TEST(Cli, SaysWhenItsOutputCannotBeWritten) {
  const Ran ran = run_program("sh", {"-c", nearmiss_program() + " list > /dev/full"});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_EQ(ran.err, "nearmiss: standard output cannot be written\n");
}

/// Without care, the next opened file, a pipe to a worker, would take the place of a closed standard file.
TEST(Cli, SaysWhenItsOutputIsClosed) {
  const TemporaryFolder folder;
  const std::string file = folder.file("case.json", case_text("[0, 0, 0]", "1"));
  const std::string command = nearmiss_program() + " replay -s collide-fast-double " + file;
  const Ran ran = run_program("sh", {"-c", command + " <&- >&-"});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_EQ(ran.err, "nearmiss: standard output cannot be written\n");
  EXPECT_EQ(run_program("sh", {"-c", command + " 2>&-"}).out,
            nearmiss({"replay", "-s", "collide-fast-double", file}).out);
}

}  // namespace
}  // namespace nearmiss
