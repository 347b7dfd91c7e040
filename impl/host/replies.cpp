#include "impl/host/replies.hpp"

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "impl/subject/printable.hpp"

namespace nearmiss::wire {

namespace {

using Json = nlohmann::json;

constexpr std::size_t max_line = std::size_t{1} << 16;

void append(std::string& text, double x) {
  std::array<char, 32> digits;
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), x);
  text.append(digits.data(), end);
}

Taken error(std::string what, bool names_its_case = false) { return {0, {}, std::move(what), names_its_case}; }

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

bool is_known(const std::string& member) {
  return member == "case" || member == "yes" || member == "values" || member == "cannot";
}

/// The number of a reply's case, or an error.
Taken case_in(const Json& j, std::uint32_t due) {
  if (!j.is_object()) return error("a line that is no object");
  const auto named = j.find("case");
  if (named == j.end() || !named->is_number_unsigned())
    return error("an object without \"case\", the number of its case");
  if (*named != due) return error(another_case(named->get<std::uint64_t>(), due));
  return {};
}

/// Puts the numbers of a reply into the answer. Returns the error; empty where there is none.
std::string take_values(const Json& values, const Due& due, Answer& a) {
  if (!values.is_array() || values.size() != due.outputs)
    return "\"values\" is no list of " + std::to_string(due.outputs) + " numbers";
  const std::uint64_t part = a.yes ? due.gives : due.gives & due.of_misses;
  for (std::size_t i = 0; i < due.outputs; ++i) {
    const Json& value = values[i];
    const bool gives = (due.gives >> i & 1u) != 0;
    if (value == "none" || (value.is_null() && (part >> i & 1u) == 0)) continue;
    if (!gives) return "number " + std::to_string(i + 1) + ", which is not among what its offer \"gives\"";
    const std::optional<double> x = value.is_null() ? std::numeric_limits<double>::quiet_NaN() : number_in(value);
    if (!x) return "\"values\" has something that is no number";
    a.values[i] = *x;
    a.given |= std::uint64_t{1} << i;
  }
  return {};
}

/// The answer in a reply that names the case that is due.
Taken answer_in(const Json& j, const Due& due, Taken taken) {
  for (const auto& [name, value] : j.items()) {
    if (is_known(name)) continue;
    return error(std::string("'").append(name, 0, 40) + "', which is none of \"case\", \"yes\", \"values\", \"cannot\"",
                 true);
  }
  if (const auto why = j.find("cannot"); why != j.end()) {
    if (j.contains("yes") || j.contains("values")) return error("\"cannot\" beside \"yes\" or \"values\"", true);
    if (!why->is_string()) return error("\"cannot\" is no text", true);
    taken.answer = Answer::without(Answer::Status::cannot_answer, why->get_ref<const std::string&>());
    return taken;
  }
  Answer& a = taken.answer;
  a.count = std::uint8_t(due.outputs);
  a.given = 0;
  const auto yes = j.find("yes");
  if (yes != j.end() && !yes->is_boolean()) return error("\"yes\" is neither true nor false", true);
  a.yes = yes == j.end() || yes->get<bool>();
  const auto values = j.find("values");
  if (yes == j.end() && values == j.end()) return error("an object without \"yes\", \"values\" and \"cannot\"", true);
  if (values == j.end()) return taken;
  if (std::string wrong = take_values(*values, due, a); !wrong.empty()) return error(std::move(wrong), true);
  return taken;
}

/// The members of all objects in it.
std::size_t members_of(const Json& j) {
  std::size_t count = j.is_object() ? j.size() : 0;
  if (!j.is_structured()) return 0;
  for (const Json& part : j) count += members_of(part);
  return count;
}

/// The characters `wanted` of the text outside of its strings.
std::size_t count_outside_strings(std::string_view json, char wanted) {
  std::size_t count = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    if (in_string && json[i] == '\\') {
      ++i;
      continue;
    }
    if (json[i] == '"') in_string = !in_string;
    count += !in_string && json[i] == wanted;
  }
  return count;
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

std::optional<std::string> repeated_member(std::string_view json, const Json& parsed) {
  if (count_outside_strings(json, ':') == members_of(parsed)) return std::nullopt;  // a parsed object has each once
  std::vector<std::set<std::string>> seen;
  std::string repeated;
  const Json::parser_callback_t look = [&](int, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) seen.emplace_back();
    if (event == Json::parse_event_t::object_end) seen.pop_back();
    if (event == Json::parse_event_t::key && !seen.back().insert(value.get<std::string>()).second)
      repeated = value.get<std::string>();
    return true;
  };
  [[maybe_unused]] const Json again = Json::parse(json, look, false);
  return repeated;
}

std::optional<std::string> difference_between(std::string_view first, std::string_view now) {
  if (first == now) return std::nullopt;
  if (nesting(now) > most_nested) return "it is nested more than 64 deep";
  const Json before = Json::parse(first, nullptr, false), after = Json::parse(now, nullptr, false);
  if (after.is_discarded())
    return "it is no JSON: " + std::string(now.substr(0, std::min<std::size_t>(now.find('\n'), 60)));
  const Json changes = Json::diff(before, after);
  if (changes.empty()) return std::nullopt;
  const Json::json_pointer where(changes.front().at("path").get<std::string>());
  const auto part = [&](const Json& hello) {
    return hello.contains(where) ? printable(hello.at(where).dump().substr(0, 60)) : std::string("missing");
  };
  const std::string name = where.empty() ? "it" : printable(where.to_string().substr(1, 60));
  return name + " was " + part(before) + " and is " + part(after);
}

std::uint64_t bits_of_output(const Query& query, std::string_view name) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; !name.empty() && i < query.outputs.size(); ++i) {
    const std::string_view output = query.outputs[i].name;
    const bool is_of_vector = output.size() > name.size() && output[name.size()] == '.';
    if (output.starts_with(name) && (output.size() == name.size() || is_of_vector)) bits |= std::uint64_t{1} << i;
  }
  return bits;
}

std::vector<std::uint64_t> given_by_offers(std::string_view hello) {
  std::vector<std::uint64_t> given;
  const Json parsed = Json::parse(hello);
  for (const Json& offer : parsed.at("offers")) {
    given.push_back(~std::uint64_t{0});
    const auto list = offer.find("gives");
    if (list == offer.end()) continue;
    const Query& query = *find_query(offer.at("query").get_ref<const std::string&>());
    given.back() = 0;
    for (const Json& name : *list) given.back() |= bits_of_output(query, name.get_ref<const std::string&>());
  }
  return given;
}

namespace {

/// A case of the query whose lists have at least one entry each.
std::vector<double> with_entries(const Query& query) {
  std::vector<double> values(query.most_numbers());
  for (std::size_t k = 0; k < query.lists.size(); ++k)
    values[query.lists.place_of_count(k, values)] = double(std::max<std::size_t>(query.lists[k].least, 1));
  return values;
}

Json names_of_inputs(const Query& query) {
  const std::vector<double> values = with_entries(query);
  const std::vector<Field>& fields = query.fields_of(values);
  Json names = Json::array();
  std::size_t list = 0;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (list == query.lists.size() || i != query.lists.place_of_count(list, values)) {
      names.push_back(fields[i].name);
      continue;
    }
    const CountedInput& counted = query.lists[list];
    const std::size_t before = counted.name.size() + std::string_view(".0.").size();
    Json entry = Json::array();
    for (std::size_t k = 1; k <= counted.numbers; ++k)
      entry.push_back(fields[i + k].name.size() > before ? fields[i + k].name.substr(before) : "");
    names.push_back({{"list", counted.name}, {"entry", std::move(entry)}});
    i += counted.numbers * query.lists.count_of(list++, values);
  }
  return names;
}

}  // namespace

Json names_of_numbers(const Query& query) {
  Json outputs = Json::array();
  for (const Field& f : query.outputs) outputs.push_back(f.name);
  return {{"query", query.name},
          {"decides", decides(query.kind)},
          {"inputs", names_of_inputs(query)},
          {"outputs", std::move(outputs)}};
}

std::string names_of_offers(std::string_view hello) {
  const Json parsed = Json::parse(hello);
  Json all = Json::array();
  for (const Json& offer : parsed.at("offers"))
    all.push_back(names_of_numbers(*find_query(offer.at("query").get_ref<const std::string&>())));
  return Json{{"names", std::move(all)}}.dump() + "\n";
}

std::string binary_request(std::uint32_t offer, std::uint32_t first, const CaseNumbers& cases, int of_version) {
  const bool has_lengths = of_version != version_without_lengths;
  const std::uint32_t begin = cases.begins.front(), numbers = cases.begins.back() - begin;
  const Request head{offer, std::uint32_t(cases.size()), first, has_lengths ? numbers : 0};
  std::string bytes;
  bytes.reserve(sizeof head + 4 * cases.size() + std::size_t{8} * numbers);
  const auto add = [&](const void* from, std::size_t size) { bytes.append(static_cast<const char*>(from), size); };
  add(&head, sizeof head);
  for (std::size_t i = 0; has_lengths && i < cases.size(); ++i) {
    const auto length = std::uint32_t(cases[i].size());
    add(&length, sizeof length);
  }
  add(cases.values.data() + begin, sizeof(double) * numbers);
  return bytes;
}

std::string json_request(std::string_view query, std::uint32_t first, const CaseNumbers& cases) {
  std::string line =
      "{\"query\": \"" + std::string(query) + "\", \"first\": " + std::to_string(first) + ", \"cases\": [";
  for (std::size_t i = 0; i < cases.size(); ++i) {
    line += i == 0 ? "[" : "], [";
    for (const double& x : cases[i]) {
      if (&x != cases[i].data()) line += ", ";
      append(line, x);
    }
  }
  return line + "]]}\n";
}

Taken take_binary(std::string_view bytes, const Due& due) {
  Reply head;
  if (bytes.size() < sizeof head) return {};
  std::memcpy(&head, bytes.data(), sizeof head);
  if (head.status > 1) return error(neither_0_nor_1("first", head.status));
  if (head.yes > 1) return error(neither_0_nor_1("second", head.yes));
  if (head.number != due.number) return error(another_case(head.number, due.number));
  Taken taken;
  const std::size_t size = sizeof head + (head.status == 0 ? 8 * due.outputs : head.reason);
  if (bytes.size() < size) return taken;
  const char* rest = bytes.data() + sizeof head;
  taken.bytes = size;
  if (head.status == 1) {
    taken.answer = Answer::without(Answer::Status::cannot_answer, {rest, head.reason});
    return taken;
  }
  Answer& a = taken.answer;
  a.yes = head.yes != 0;
  a.given = head.given & due.gives;
  a.count = std::uint8_t(due.outputs);
  std::memcpy(a.values.data(), rest, 8 * due.outputs);
  return taken;
}

Taken take_json(std::string_view bytes, const Due& due) {
  const std::size_t end = bytes.find('\n');
  if (end == std::string_view::npos) return bytes.size() > max_line ? error("a line without end") : Taken{};
  if (end > max_line) return error("a line of more than 65,536 bytes");
  if (nesting(bytes.substr(0, end)) > most_nested) return error("a line that is nested more than 64 deep");
  const std::string line = with_quoted_words(bytes.substr(0, end));
  const Json j = Json::parse(line, nullptr, false);
  if (j.is_discarded())
    return error("a line that is no JSON: " + std::string(bytes.substr(0, std::min<std::size_t>(end, 60))));
  if (const Taken named = case_in(j, due.number); !named.error.empty()) return named;
  if (const auto twice = repeated_member(line, j))
    return error("'" + twice->substr(0, 40) + "' twice in one object", *twice != "case");
  return answer_in(j, due, {end + 1, {}, {}});
}

}  // namespace nearmiss::wire
