#include "impl/host/replies.hpp"

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

namespace nearmiss::wire {

namespace {

using Json = nlohmann::json;

constexpr std::size_t max_line = std::size_t{1} << 16;

void append(std::string& text, double x) {
  std::array<char, 32> digits;
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), x);
  text.append(digits.data(), end);
}

Taken error(std::string what) { return {0, {}, std::move(what)}; }

/// Quotes Infinity, -Infinity and NaN, which some JSON writers print as bare words.
std::string with_quoted_words(std::string_view line) {
  std::string quoted;
  bool in_string = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (in_string && line[i] == '\\' && i + 1 < line.size()) quoted += line[i++];
    if (line[i] == '"') in_string = !in_string;
    bool replaced = false;
    for (const std::string_view word : {"-Infinity", "Infinity", "NaN"}) {
      if (in_string || line.substr(i, word.size()) != word) continue;
      quoted += '"' + std::string(word) + '"';
      i += word.size() - 1;
      replaced = true;
      break;
    }
    if (!replaced) quoted += line[i];
  }
  return quoted;
}

std::optional<double> number_in(const Json& j) {
  if (j.is_number()) return j.get<double>();
  if (!j.is_string()) return std::nullopt;
  const auto& word = j.get_ref<const std::string&>();
  constexpr double inf = std::numeric_limits<double>::infinity();
  if (word == "inf" || word == "Infinity") return inf;
  if (word == "-inf" || word == "-Infinity") return -inf;
  if (word == "nan" || word == "NaN") return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

std::string another_case(std::uint64_t named, std::uint32_t number) {
  const std::string due = std::to_string(number);
  return std::string("an answer to case ").append(std::to_string(named)) + " where one to case " + due + " is due";
}

std::string neither_0_nor_1(const char* which, int byte) {
  return std::string("an answer whose ").append(which).append(" byte is ").append(std::to_string(byte)) +
         ": it must be 0 or 1";
}

Taken answer_in(const Json& j, std::uint32_t number, std::size_t outputs, Taken taken) {
  if (!j.is_object()) return error("a line that is no object");
  for (const auto& [name, value] : j.items()) {
    if (name != "case" && name != "yes" && name != "values" && name != "cannot") {
      return error(std::string("'").append(name, 0, 40) +
                   "', which is none of \"case\", \"yes\", \"values\", \"cannot\"");
    }
  }
  const auto named = j.find("case");
  if (named == j.end() || !named->is_number_unsigned())
    return error("an object without \"case\", the number of its case");
  if (*named != number) return error(another_case(named->get<std::uint64_t>(), number));
  if (const auto why = j.find("cannot"); why != j.end()) {
    if (j.contains("yes") || j.contains("values")) return error("\"cannot\" beside \"yes\" or \"values\"");
    if (!why->is_string()) return error("\"cannot\" is no text");
    taken.answer = Answer::without(Answer::Status::cannot_answer, why->get_ref<const std::string&>());
    return taken;
  }
  Answer& a = taken.answer;
  a.count = std::uint8_t(outputs);
  a.given = 0;
  const auto yes = j.find("yes");
  if (yes != j.end() && !yes->is_boolean()) return error("\"yes\" is neither true nor false");
  a.yes = yes == j.end() || yes->get<bool>();
  const auto values = j.find("values");
  if (yes == j.end() && values == j.end()) return error("an object without \"yes\", \"values\" and \"cannot\"");
  if (values == j.end()) return taken;
  if (!values->is_array() || values->size() != outputs) {
    return error("\"values\" is no list of " + std::to_string(outputs) + " numbers");
  }
  for (std::size_t i = 0; i < outputs; ++i) {
    const Json& value = (*values)[i];
    if (value.is_null()) continue;
    const std::optional<double> x = number_in(value);
    if (!x) return error("\"values\" has something that is no number");
    a.values[i] = *x;
    a.given |= std::uint64_t{1} << i;
  }
  return taken;
}

}  // namespace

std::size_t nesting(std::string_view json) {
  std::size_t deepest = 0, depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text && c == '\\') ++i;
    if (c == '"') in_text = !in_text;
    if (in_text) continue;
    if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
    if ((c == ']' || c == '}') && depth > 0) --depth;
  }
  return deepest;
}

std::string binary_request(std::uint32_t offer, std::uint32_t first, std::span<const double> values,
                           std::size_t inputs) {
  const Request head{offer, std::uint32_t(values.size() / inputs), first, 0};
  std::string bytes(sizeof head + values.size_bytes(), '\0');
  std::memcpy(bytes.data(), &head, sizeof head);
  std::memcpy(bytes.data() + sizeof head, values.data(), values.size_bytes());
  return bytes;
}

std::string json_request(std::string_view query, std::uint32_t first, std::span<const double> values,
                         std::size_t inputs) {
  std::string line =
      "{\"query\": \"" + std::string(query) + "\", \"first\": " + std::to_string(first) + ", \"cases\": [";
  for (std::size_t i = 0; i < values.size(); ++i) {
    line += i % inputs == 0 ? i == 0 ? "[" : "], [" : ", ";
    append(line, values[i]);
  }
  return line + "]]}\n";
}

Taken take_binary(std::string_view bytes, std::uint32_t number, std::size_t outputs) {
  Reply head;
  if (bytes.size() < sizeof head) return {};
  std::memcpy(&head, bytes.data(), sizeof head);
  if (head.status > 1) return error(neither_0_nor_1("first", head.status));
  if (head.yes > 1) return error(neither_0_nor_1("second", head.yes));
  if (head.number != number) return error(another_case(head.number, number));
  Taken taken;
  const std::size_t size = sizeof head + (head.status == 0 ? 8 * outputs : head.reason);
  if (bytes.size() < size) return taken;
  const char* rest = bytes.data() + sizeof head;
  taken.bytes = size;
  if (head.status == 1) {
    taken.answer = Answer::without(Answer::Status::cannot_answer, {rest, head.reason});
    return taken;
  }
  Answer& a = taken.answer;
  a.yes = head.yes != 0;
  a.given = head.given;
  a.count = std::uint8_t(outputs);
  std::memcpy(a.values.data(), rest, 8 * outputs);
  return taken;
}

Taken take_json(std::string_view bytes, std::uint32_t number, std::size_t outputs) {
  const std::size_t end = bytes.find('\n');
  if (end == std::string_view::npos) return bytes.size() > max_line ? error("a line without end") : Taken{};
  if (end > max_line) return error("a line of more than 65,536 bytes");
  if (nesting(bytes.substr(0, end)) > most_nested) return error("a line that is nested more than 64 deep");
  const Json j = Json::parse(with_quoted_words(bytes.substr(0, end)), nullptr, false);
  if (j.is_discarded())
    return error("a line that is no JSON: " + std::string(bytes.substr(0, std::min<std::size_t>(end, 60))));
  return answer_in(j, number, outputs, {end + 1, {}, {}});
}

}  // namespace nearmiss::wire
