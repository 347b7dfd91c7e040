#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "corpus/files/errors.hpp"
#include "corpus/files/files.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/findings/encoded.hpp"
#include "reports/upstream/asking.hpp"
#include "reports/upstream/source_units.hpp"

namespace nearmiss {

namespace engine_text {
namespace {

namespace fs = std::filesystem;

std::string joined(const std::vector<SourceUnit>& units, const std::vector<bool>& needed) {
  std::string text;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const std::string_view between = text.empty() || !units[i].begins_paragraph ? "" : "\n";
    if (needed[i]) text.append(between).append(units[i].comment).append(units[i].text).append("\n");
  }
  return text;
}

[[noreturn]] void refuse(const Case& question, const Engine& engine) {
  throw BadInput(fmt::format("no test can be written: {} has no function for {}", engine.name, question.query->name));
}

// --- packages of npm, in JavaScript ---

constexpr Language js = Language::javascript;

/// `q`, the inputs as nearmiss.mjs gives them to a function.
std::string object_text(const nlohmann::ordered_json& j, const std::string& indent = "") {
  if (j.is_number()) return literal(j.get<double>());
  std::string text;
  const bool is_list = j.is_array();
  for (const auto& [name, value] : j.items()) {
    const std::string key = is_list ? "" : name + ": ";
    const bool is_line = !indent.empty() && !is_list;
    text += (is_line ? indent : text.empty() ? "" : ", ") + key + object_text(value) + (is_line ? ",\n" : "");
  }
  if (is_list) return "[" + text + "]";
  return indent.empty() ? "{ " + text + " }" : "{\n" + text + "}";
}
std::string inputs_object(const Case& question) {
  nlohmann::ordered_json inputs;
  for (std::size_t i = 0; i < question.values.size(); ++i) {
    std::string at = "/" + question.name(i);
    for (char& c : at) c = c == '.' ? '/' : c;
    constexpr std::string_view axes = "xyzw";
    const bool is_axis = at.size() > 2 && at[at.size() - 2] == '/' && axes.find(at.back()) != axes.npos;
    if (is_axis) at.back() = char('0' + int(axes.find(at.back())));
    inputs[nlohmann::ordered_json::json_pointer(at)] = question.values[i];
  }
  return object_text(inputs, "  ");
}

/// The function of the table that answers the query, as an expression.
std::string function_for(const Case& question, const Engine& engine, const std::vector<SourceUnit>& units) {
  for (const SourceUnit& u : units) {
    const std::size_t at = behind_name(u.text, js, question.query->name, ':');
    if (at == std::string::npos) continue;
    const std::string offer = items_of_list(std::string_view(u.text).substr(at), js).at(0);
    if (!offer.starts_with("{")) return offer;
    const std::size_t answer = behind_name(offer, js, "answer", ':');
    if (answer != std::string::npos) return items_of_list(std::string_view(offer).substr(answer), js).at(0);
  }
  refuse(question, engine);
}

/// `declares` and its like in place of what the command line of a subject sets.
std::vector<SourceUnit> settings_of(const Engine& engine) {
  const std::string word = engine.setting.empty() ? "undefined" : c_string(engine.setting);
  std::vector<SourceUnit> units = units_of(
      "/** Whether an answer leaves out what the documentation calls undefined. */\nconst declares = true;\n"
      "const packaged = (specifier) => ({ file: createRequire(import.meta.url).resolve(specifier) });\n"
      "import { createRequire } from \"node:module\";\n"
      "/** Settings other than the usual ones. */\nconst setting = " +
          word + ";\n",
      js);
  for (SourceUnit& u : units) u.in_head = u.begins_paragraph = false;
  return units;
}

bool is_import(const SourceUnit& u) { return u.text.starts_with("import "); }
bool is_local_import(const SourceUnit& u) { return is_import(u) && u.text.find("from \".") != std::string::npos; }

/// `const { version, library: T } = await load("three");` as an import of "three".
bool becomes_import(SourceUnit& u) {
  constexpr std::string_view start = "const { ", call = "await load(";
  const std::size_t at = u.text.find(call);
  if (!u.text.starts_with(start) || at == std::string::npos) return false;
  std::string what = items_of_list(std::string_view(u.text).substr(start.size()), js).back();
  const std::size_t renamed = behind_name(what, js, "library", ':');
  if (renamed != std::string::npos) what = what.substr(what.find_first_not_of(' ', renamed));
  if (!what.starts_with("{")) what = "* as " + what;
  const std::string package = items_of_list(std::string_view(u.text).substr(at + call.size()), js).at(0);
  u.text = fmt::format("import {} from {};", what, package);
  u.words.clear();
  return true;
}

/// Adds the units of a file, but for the names that settings_of() has, and those that answer the cases of Nearmiss.
void add_units(const fs::path& file, bool is_shared, std::vector<SourceUnit>& all) {
  static const std::set<std::string> not_taken{"declares", "setting", "packaged", "load", "answerBy", "answer"};
  bool begins_paragraph = false;
  for (SourceUnit& u : units_of(read_file(file), js)) {
    const bool is_taken =
        std::none_of(u.names.begin(), u.names.end(), [](const auto& n) { return not_taken.contains(n); });
    if (!is_taken || is_local_import(u) || (is_shared && !u.text.starts_with("export "))) continue;
    if (is_shared) u.text.erase(0, std::string_view("export ").size());
    if (u.text.starts_with("answerBy(")) u.names = {"answerBy"};  // which nothing mentions
    u.in_head = u.in_head && !is_shared;
    begins_paragraph = begins_paragraph || u.begins_paragraph;
    if (!becomes_import(u) && !is_import(u)) u.begins_paragraph = std::exchange(begins_paragraph, false);
    all.push_back(std::move(u));
  }
}

/// The units of the subject, and before them those of what it imports from this source tree.
std::vector<SourceUnit> javascript_units(const Engine& engine) {
  std::vector<SourceUnit> all = settings_of(engine);
  const fs::path sources = engine.sources;
  add_units(sources / "../../program/nearmiss.mjs", true, all);
  add_units(sources / "../engine.mjs", true, all);
  add_units(sources / "subject.mjs", false, all);
  return all;
}

/// "npm install three@0.187.0".
std::string npm_install(const Engine& engine) {
  const std::string file = engine.sources + "/package.json";
  std::string packages;
  const nlohmann::json package = parse_json(read_file(file), file);
  for (const auto& [name, version] : package.at("dependencies").items())
    packages += fmt::format(" {}@{}", name, version.get<std::string>());
  return "npm install" + packages;
}

constexpr std::string_view no_answer = "  if (said instanceof Cannot) throw new Error(`no answer: ${said.why}`);\n";
constexpr std::string_view answer_of = R"(
/** Whether the answer is yes, with its numbers. */
function answerOf(said) {
$no_answer  return typeof said === "object" && said !== null ? { yes: true, ...said } : { yes: said === true };
}
)";

/// The lines behind the first one without the indentation that they share.
std::string without_indentation(std::string_view text) {
  std::size_t least = text.size();
  for (std::size_t at = text.find('\n'); at < text.size(); at = text.find('\n', at + 1))
    least = std::min(least, text.find_first_not_of(" \n", at) - at - 1);
  std::string out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    out += text[at];
    if (text[at] == '\n') at += least;
  }
  return out;
}

/// The call of the function for `q`.
std::string call_of(const std::string& function) {
  constexpr std::string_view arrow = "(q) => ";
  if (function.starts_with(arrow) && function[arrow.size()] != '{')
    return fmt::format("const got = answerOf({});\n", function.substr(arrow.size()));
  if (function.find("=>") == std::string::npos || function.ends_with(")"))
    return fmt::format("const got = answerOf({}(q));\n", function);
  return fmt::format("const ask = {};\nconst got = answerOf(ask(q));\n", without_indentation(function));
}

Asking in_javascript(const Case& question, const Engine& engine) {
  std::vector<SourceUnit> units = javascript_units(engine);
  const std::string function = function_for(question, engine, units);
  const std::vector<bool> needed = needed_units(units, words_of_source(function, js));
  std::vector<bool> imported(units.size()), declared(units.size());
  bool may_refuse = false;
  for (std::size_t i = 0; i < units.size(); ++i) {
    (is_import(units[i]) ? imported : declared)[i] = needed[i];
    if (is_import(units[i])) units[i].comment.clear(), units[i].begins_paragraph = false;
    may_refuse = may_refuse || (needed[i] && units[i].text.starts_with("class Cannot"));
  }
  Asking asking;
  asking.style = Asking::Style::javascript;
  asking.includes = joined(units, imported);
  asking.helpers =
      joined(units, declared) + filled_in(answer_of, {{"no_answer", may_refuse ? std::string(no_answer) : ""}});
  asking.statements = fmt::format("const q = {};\n", inputs_object(question)) + call_of(function);
  asking.members = member_names(*question.query);
  asking.may_leave_out = true;
  asking.build = npm_install(engine) + " && node --test finding.test.mjs";
  return asking;
}

// --- libraries of Debian, in C++ ---

constexpr std::string_view answer_struct =
    R"(/// The answer of a function below. Bit i of `given`: values[i] is part of it.
struct Result {
  int yes = 0;
  std::uint64_t given = ~std::uint64_t{0};
  double values[$count] = {};
  char why[200] = "";
};
enum { answered, no_answer };

)";

std::string cpp_function_for(const Case& question, const Engine& engine, const std::vector<SourceUnit>& units) {
  constexpr std::size_t place = 5;  // of the function in a nearmiss_offer
  const std::string start = fmt::format("{{\"{}\",", question.query->name);
  for (const SourceUnit& u : units) {
    const std::size_t at = u.text.find(start);
    if (at != std::string::npos)
      return items_of_list(std::string_view(u.text).substr(at + 1), Language::cpp, true).at(place);
  }
  refuse(question, engine);
}

/// Those of its group in cmake/packages.txt.
std::string packages_of(const Engine& engine) {
  const fs::path sources = engine.sources;
  const std::string all = read_file(sources / "../../../cmake/packages.txt");
  const std::string group = "[" + sources.filename().string() + "]\n";
  std::string packages;
  const std::size_t start = all.find(group);
  if (start == std::string::npos) return packages;
  std::istringstream lines(all.substr(start + group.size()));
  for (std::string line; std::getline(lines, line) && !line.starts_with('[');) {
    if (!line.empty() && !line.starts_with('#')) packages += (packages.empty() ? "" : " ") + line;
  }
  return packages;
}

Asking in_cpp(const Case& question, const Engine& engine) {
  const fs::path sources = engine.sources;
  const std::vector<SourceUnit> units = units_of(read_file(sources / "subject.cpp"), Language::cpp);
  const std::string function = cpp_function_for(question, engine, units);
  const Query& query = *question.query;
  Asking asking;
  for (const SourceUnit& u : units) {
    if (u.text.starts_with("#include <")) asking.includes += u.text + "\n";
  }
  if (asking.includes.find("<cstdint>") == std::string::npos) asking.includes += "#include <cstdint>\n";
  const std::string count = std::to_string(std::max<std::size_t>(query.outputs.size(), 1));
  asking.helpers =
      filled_in(answer_struct, {{"count", count}}) +
      with_words(joined(units, needed_units(units, words_of_source(function, Language::cpp))), Language::cpp,
                 {{"nearmiss_answer", "Result"},
                  {"NEARMISS_ANSWERED", "answered"},
                  {"NEARMISS_CANNOT_ANSWER", "no_answer"},
                  {"SETTING", c_string(engine.setting)}});
  asking.statements =
      fmt::format("const double in[] = {{\n{}}};\n", listed_inputs(question)) +
      fmt::format("Result answer;\nif ({}(in, sizeof in / sizeof *in, &answer) != answered) {{\n", function) +
      "  std::printf(\"FAILED: no answer: %s\\n\", answer.why);\n  return 1;\n}\n" + take_answer(query, false);
  asking.members = member_names(query);
  asking.may_leave_out = true;
  std::string flags = read_file(sources / "flags.txt");
  flags.erase(flags.find_last_not_of('\n') + 1);
  asking.build = fmt::format("g++ -std=c++20 test.cpp {}", flags);
  asking.packages = packages_of(engine);
  return asking;
}

}  // namespace
}  // namespace engine_text

Asking ask_engine(const Case& question, const Engine& engine) {
  return engine.is_plugin ? engine_text::in_cpp(question, engine) : engine_text::in_javascript(question, engine);
}

}  // namespace nearmiss
