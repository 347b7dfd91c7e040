#include "properties/hand_derived.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace nearmiss {

namespace {

const std::set<std::string> known_classes{"hit", "miss", "touch", "inside", "tie", "degenerate", "gate"};

/// What is wrong with a line.
struct BadLine : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// The parts of a text between separators outside parentheses, trimmed.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
    if (depth != 0 || text[i] != separator) continue;
    parts.push_back(trimmed(text.substr(begin, i - begin)));
    begin = i + 1;
  }
  if (depth != 0) throw BadLine(fmt::format("\"{}\" has unbalanced parentheses", text));
  parts.push_back(trimmed(text.substr(begin)));
  return parts;
}

// Numbers.

double decimal(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    throw BadLine(fmt::format("\"{}\" is not a number", text));
  }
  return value;
}

/// "1.5", "inf", "2^-51", "sqrt(1/2)".
double term(std::string_view text) {
  if (text.starts_with('-') && !text.starts_with("--")) return -term(text.substr(1));
  if (text == "inf") return std::numeric_limits<double>::infinity();
  if (text.starts_with("2^")) return std::exp2(decimal(text.substr(2)));
  if (text.starts_with("sqrt(") && text.ends_with(')')) {
    const std::string_view inside = text.substr(5, text.size() - 6);
    const std::vector<std::string_view> ratio = split(inside, '/');
    if (ratio.size() != 2) throw BadLine(fmt::format("\"{}\" is not a ratio", inside));
    return std::sqrt(decimal(ratio[0]) / decimal(ratio[1]));
  }
  return decimal(text);
}

/// A term or a sum of two: "2 + 2^-51".
double number(std::string_view text) {
  const std::size_t plus = text.find(" + ");
  return plus == text.npos ? term(text) : term(text.substr(0, plus)) + term(text.substr(plus + 3));
}

// Fields.

bool is_below(std::string_view name, std::string_view field) {
  return name == field || (name.starts_with(field) && name[field.size()] == '.');
}

/// "location" of the component "location.x", the whole name of a scalar.
std::string_view vector_of(std::string_view name) {
  const std::size_t dot = name.find_last_of('.');
  if (dot == name.npos) return name;
  const std::string_view last = name.substr(dot + 1);
  const bool component = last == "x" || last == "y" || last == "z" || last == "w";
  return component ? name.substr(0, dot) : name;
}

/// The inputs or the answer of a query while their fields are read.
class NumberFields {
 public:
  explicit NumberFields(std::span<const Field> fields) : fields_(fields), values_(fields.size()) {}
  /// The inputs of a case; those of the given numbers that are counts are set.
  NumberFields(const Query& query, std::span<const double> counts) : NumberFields(query.fields_of(counts)) {
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      if (fields_[i].role == Role::count) values_[i] = counts[i];
    }
  }

  /// Reads "NAME = VALUE; NAME = VALUE" and replaces what an earlier call has set.
  void read(const std::vector<std::string_view>& assignments) {
    std::set<std::size_t> set;
    for (const std::string_view assignment : assignments) {
      const std::size_t equals = assignment.find('=');
      if (equals == assignment.npos) throw BadLine(fmt::format("\"{}\" is not NAME = VALUE", assignment));
      assign(trimmed(assignment.substr(0, equals)), trimmed(assignment.substr(equals + 1)), set);
    }
  }
  /// The first vector or scalar that has no value.
  std::optional<std::string_view> missing() const {
    const auto at = std::find(values_.begin(), values_.end(), std::nullopt);
    if (at == values_.end()) return std::nullopt;
    return vector_of(fields_[std::size_t(at - values_.begin())].name);
  }
  const std::vector<std::optional<double>>& values() const { return values_; }

 private:
  void assign(std::string_view name, std::string_view value, std::set<std::size_t>& set) {
    const auto below = [&](const Field& field) { return is_below(field.name, name); };
    const auto first = std::find_if(fields_.begin(), fields_.end(), below);
    if (first == fields_.end()) throw BadLine(fmt::format("the query has no number \"{}\"", name));
    std::size_t at = std::size_t(first - fields_.begin());
    if (fields_[at].role == Role::count) ++at;  // follows from the entries
    const std::size_t end = std::size_t(std::find_if_not(first, fields_.end(), below) - fields_.begin());
    for (const std::string_view item : split(value, ',')) {
      if (at == end) throw BadLine(fmt::format("{} has too many numbers", name));
      for (const double x : item_values(item, at)) {
        if (!set.insert(at).second) throw BadLine(fmt::format("{} is set twice", fields_[at].name));
        values_[at++] = x;
      }
    }
    if (at != end) throw BadLine(fmt::format("{} has too few numbers: {} is missing", name, fields_[at].name));
  }
  /// The numbers of "1" or "(1, 2, 3)", as many as the vector or scalar that begins at `at` has.
  std::vector<double> item_values(std::string_view item, std::size_t at) const {
    const std::string_view whole = vector_of(fields_[at].name);
    const auto count = std::count_if(fields_.begin() + std::ptrdiff_t(at), fields_.end(),
                                     [&](const Field& field) { return vector_of(field.name) == whole; });
    std::vector<double> values;
    if (count > 1) {
      if (!item.starts_with('(') || !item.ends_with(')'))
        throw BadLine(fmt::format("{} is not a vector (x, y, …)", whole));
      for (const std::string_view x : split(item.substr(1, item.size() - 2), ',')) values.push_back(number(x));
    } else {
      values.push_back(number(item));
    }
    if (std::ptrdiff_t(values.size()) != count) {
      throw BadLine(fmt::format("{} has {} numbers, not {}", whole, count, values.size()));
    }
    return values;
  }

  std::span<const Field> fields_;
  std::vector<std::optional<double>> values_;
};

/// Numbers of 0 with the counts of the lists: of the entries in the last of "LIST = (x, y, z), (x, y, z)".
std::vector<double> counts_in(const Query& query, const std::vector<std::string_view>& assignments) {
  std::vector<double> numbers(query.most_numbers());
  for (std::size_t k = 0; k < query.lists.size(); ++k) {
    const CountedInput& list = query.lists[k];
    std::size_t count = list.least;
    for (const std::string_view assignment : assignments) {
      const std::size_t equals = std::min(assignment.find('='), assignment.size());
      if (trimmed(assignment.substr(0, equals)) == list.name) count = split(assignment.substr(equals), ',').size();
    }
    if (count > list.most) throw BadLine(fmt::format("{} has more than {} entries", list.name, list.most));
    numbers[query.lists.place_of_count(k, numbers)] = double(count);
  }
  numbers.resize(query.numbers_of(numbers));
  return numbers;
}

/// The words of a yes and of a no, as reports show them.
std::pair<std::string_view, std::string_view> decision_words(Kind kind) {
  switch (kind) {
    case Kind::impact: return {"hit", "miss"};
    case Kind::depth: return {"overlap", "apart"};
    default: return {"yes", "no"};
  }
}

/// Parses "DECISION; NAME = VALUE; …", without a decision for a query that decides nothing.
Answer parse_answer(const Query& query, std::string_view text) {
  std::vector<std::string_view> parts = split(text, ';');
  Answer answer;
  answer.yes = true;
  if (decides(query.kind)) {
    const auto [yes, no] = decision_words(query.kind);
    if (parts[0] != yes && parts[0] != no) {
      throw BadLine(fmt::format("an answer to {} begins with \"{}\" or \"{}\"", query.name, yes, no));
    }
    answer.yes = parts[0] == yes;
    parts.erase(parts.begin());
  }
  NumberFields numbers(query.outputs);
  numbers.read(parts);
  answer.given = 0;
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    const std::optional<double>& x = numbers.values()[i];
    if (!x) continue;
    answer.values[i] = *x;
    answer.given |= std::uint64_t{1} << i;
  }
  return answer;
}

/// A line with the indented lines that continue it.
struct Statement {
  int line;
  std::string text;
};

/// Without comments and empty lines.
std::vector<Statement> statements(std::string_view text) {
  std::vector<Statement> all;
  std::istringstream lines{std::string(text)};
  int number = 0;
  bool continues = false;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::string_view content = trimmed(line);
    if (content.empty() || content.starts_with('#')) {
      continues = false;
    } else if (continues && line.starts_with(' ')) {
      all.back().text.append(" ").append(content);
    } else {
      all.push_back({number, std::string(content)});
      continues = true;
    }
  }
  return all;
}

/// The state between the statements of a file.
class Parser {
 public:
  Parser(const Query& query, HandDerivedFile& into) : query_(query), into_(into) {}

  void statement(std::string_view text, const std::string& where) {
    const std::size_t space = text.find(' ');
    const std::string_view keyword = text.substr(0, space);
    const std::string_view rest = space == text.npos ? std::string_view{} : trimmed(text.substr(space));
    if (keyword == "classes") {
      classes(rest);
    } else if (keyword == "common") {
      end_of_inputs();
      common_.clear();
      if (query_.lists.empty()) inputs_of(split(rest, ';'));  // its errors are those of this line
      common_ = rest;
    } else if (keyword == "given") {
      end_of_inputs();
      given(rest, where);
    } else if (keyword == "right" || keyword == "wrong") {
      answer(keyword == "right", rest, where);
    } else {
      throw BadLine(fmt::format("\"{}\" is none of classes, common, given, right, wrong", keyword));
    }
  }
  void end_of_file() {
    end_of_inputs();
    if (into_.classes.empty()) throw BadLine("the file has no line \"classes\"");
  }

 private:
  void classes(std::string_view names) {
    for (const std::string_view name : split(names, ',')) {
      if (!known_classes.contains(std::string(name))) throw BadLine(fmt::format("\"{}\" is no class", name));
      if (!into_.classes.insert(std::string(name)).second) throw BadLine(fmt::format("{} stands twice", name));
    }
  }
  void given(std::string_view text, const std::string& where) {
    given_where_ = where;
    inputs_.clear();
    stage_ = Stage::bad_inputs;
    std::vector<std::string_view> assignments;
    if (!common_.empty()) assignments = split(common_, ';');
    const std::size_t own = assignments.size();
    for (const std::string_view part : split(text, ';')) assignments.push_back(part);
    const NumberFields all = inputs_of(assignments, own);
    if (const auto missing = all.missing()) throw BadLine(fmt::format("{} is missing", *missing));
    for (const std::optional<double>& x : all.values()) inputs_.push_back(*x);
    if (const auto invalid = query_.broken(inputs_)) throw BadLine(invalid->text());
    stage_ = Stage::inputs;
  }
  /// The assignments from `own` on replace those before.
  NumberFields inputs_of(const std::vector<std::string_view>& assignments, std::size_t own = 0) const {
    const auto middle = assignments.begin() + std::ptrdiff_t(own);
    NumberFields inputs(query_, counts_in(query_, assignments));
    inputs.read({assignments.begin(), middle});
    inputs.read({middle, assignments.end()});
    return inputs;
  }
  void answer(bool right, std::string_view text, const std::string& where) {
    if (stage_ == Stage::bad_inputs) return;
    if (stage_ == Stage::start) throw BadLine("no line \"given\" is before this answer");
    stage_ = Stage::answers;
    const std::size_t colon = text.find(':');
    if (colon == text.npos) throw BadLine("an answer is NAME: ANSWER");
    const std::string name(trimmed(text.substr(0, colon)));
    HandDerived row{&query_, name, inputs_, right, parse_answer(query_, trimmed(text.substr(colon + 1))), where};
    if (!known_classes.contains(row.class_name())) {
      throw BadLine(fmt::format("the name \"{}\" does not begin with a class", name));
    }
    if (!names_.insert(name).second) throw BadLine(fmt::format("{} stands twice", name));
    into_.answers.push_back(std::move(row));
  }
  void end_of_inputs() {
    if (std::exchange(stage_, Stage::start) == Stage::inputs) {
      into_.errors.push_back(fmt::format("{}: no answer follows these inputs", given_where_));
    }
  }

  const Query& query_;
  std::string common_;
  HandDerivedFile& into_;
  enum class Stage { start, inputs, bad_inputs, answers } stage_ = Stage::start;
  std::string given_where_;
  std::vector<double> inputs_;
  std::set<std::string> names_;
};

}  // namespace

HandDerivedFile parse_hand_derived(const Query& query, std::string_view file, std::string_view text) {
  HandDerivedFile into;
  Parser parser(query, into);
  const auto collect_errors = [&](const std::string& where, const auto& parse) {
    try {
      parse();
    } catch (const BadLine& bad) {
      into.errors.push_back(fmt::format("{}: {}", where, bad.what()));
    }
  };
  for (const Statement& s : statements(text)) {
    const std::string where = fmt::format("{}:{}", file, s.line);
    collect_errors(where, [&] { parser.statement(s.text, where); });
  }
  const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
  collect_errors(fmt::format("{}:{}", file, lines), [&] { parser.end_of_file(); });
  return into;
}

std::map<std::string, HandDerivedFile> read_hand_derived(const std::string& folder) {
  std::map<std::string, HandDerivedFile> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".txt") continue;
    const std::string name = entry.path().filename().string(), query_name = entry.path().stem().string();
    if (const Query* query = find_query(query_name)) {
      std::ifstream in(entry.path());
      files[query_name] = parse_hand_derived(*query, name, std::string{std::istreambuf_iterator<char>(in), {}});
    } else {
      files[query_name].errors.push_back(fmt::format("{}:1: the catalogue has no query {}", name, query_name));
    }
  }
  for (const Query& query : catalogue()) {
    const std::string name(query.name);
    if (!files.contains(name)) files[name].errors.push_back(fmt::format("{}.txt:1: there is no such file", name));
  }
  return files;
}

}  // namespace nearmiss
