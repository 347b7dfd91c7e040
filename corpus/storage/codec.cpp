#include "corpus/storage/codec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>

#include "corpus/files/near_words.hpp"
#include "corpus/generator/generator.hpp"

namespace nearmiss {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// Consecutive fields that share the next component of their names.
struct Child {
  std::string_view component;
  std::size_t begin, end;
  bool leaf;  ///< the component ends the name
};

/// A list of counted entries: its count, and its entries by their numbers.
bool is_counted_list(std::span<const Field> fields, std::span<const Child> of) {
  return !of.empty() && of.front().leaf && fields[of.front().begin].role == Role::count;
}

/// Splits fields whose names share their first `prefix` characters.
std::vector<Child> children(std::span<const Field> fields, std::size_t prefix) {
  std::vector<Child> found;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string_view rest = std::string_view(fields[i].name).substr(prefix);
    const std::string_view component = rest.substr(0, rest.find('.'));
    if (!found.empty() && found.back().component == component) {
      found.back().end = i + 1;
    } else {
      found.push_back({component, i, i + 1, component.size() == rest.size()});
    }
  }
  return found;
}

std::size_t below(std::size_t prefix, const Child& c) { return prefix + c.component.size() + 1; }

bool are_numbers(std::span<const Child> of, std::initializer_list<std::string_view> names) {
  return std::equal(of.begin(), of.end(), names.begin(), names.end(),
                    [](const Child& c, std::string_view name) { return c.leaf && c.component == name; });
}
bool is_quaternion(std::span<const Child> of) { return are_numbers(of, {"x", "y", "z", "w"}); }

/// Vectors (exactly x, y, z) and numbered members become arrays, all other groups objects.
bool is_array(std::span<const Child> of) {
  const auto numbered = [](const Child& c) {
    return c.component.find_first_not_of("0123456789") == std::string_view::npos;
  };
  if (!of.empty() && std::all_of(of.begin(), of.end(), numbered)) return true;
  return are_numbers(of, {"x", "y", "z"});
}

ordered_json number_to_json(Role role, double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
  if (role == Role::flag) return value != 0;
  if (is_discrete(role)) return static_cast<std::int64_t>(value);
  return value;
}

ordered_json nested(std::span<const Field> fields, std::span<const double> values, std::size_t prefix) {
  std::vector<Child> parts = children(fields, prefix);
  const bool is_list = is_counted_list(fields, parts), array = is_list || is_array(parts);
  if (is_list) parts.erase(parts.begin());  // an array has its count
  ordered_json j = array ? ordered_json::array() : ordered_json::object();
  for (const Child& c : parts) {
    ordered_json value = c.leaf ? number_to_json(fields[c.begin].role, values[c.begin])
                                : nested(fields.subspan(c.begin, c.end - c.begin),
                                         values.subspan(c.begin, c.end - c.begin), below(prefix, c));
    if (array) {
      j.push_back(std::move(value));
    } else {
      j[std::string(c.component)] = std::move(value);
    }
  }
  return j;
}

/// The value as JSON, truncated to fit into one line.
std::string shown(const json& j) {
  std::string text = j.dump(-1, ' ', true, json::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

std::string cut(const std::string& s) { return s.size() > 40 ? s.substr(0, 37) + "..." : s; }

bool has_control_characters(std::string_view s) {
  return std::any_of(s.begin(), s.end(), [](char c) { return (0 <= c && c < 0x20) || c == 0x7F; });
}

/// The list whose count is the last of these numbers.
const CountedInput& list_counted_by_last(const Query& query, std::span<const double> numbers) {
  std::size_t k = 0;
  while (query.lists.place_of_count(k, numbers) + 1 != numbers.size()) ++k;
  return query.lists[k];
}

std::mutex counting_rounded;
RoundedNumbers rounded;
Decimals users_decimals = Decimals::nearest;

/// The nearest number of the scalar.
double nearest_in(double x, Scalar scalar) { return scalar == Scalar::float32 ? double(float(x)) : x; }

/// The numbers of a 3x3 matrix, given as three rows or as nine numbers; empty for any other value.
std::vector<double> matrix_in(const json& j) {
  std::vector<double> numbers;
  const auto add = [&](const json& list) {
    for (const json& x : list) numbers.push_back(x.is_number() ? x.get<double>() : HUGE_VAL);
  };
  if (j.size() == 9) add(j);
  if (j.size() == 3 && std::all_of(j.begin(), j.end(), [](const json& r) { return r.is_array() && r.size() == 3; })) {
    for (const json& row : j) add(row);
  }
  return numbers;
}

/// How to give the rotation of a matrix: its quaternion, where the matrix is one of a rotation to about a thousandth.
std::string quaternion_text(std::span<const double> m) {
  constexpr double near = 1e-3;
  const double w = std::sqrt(std::max(0.0, 1 + m[0] + m[4] + m[8])) / 2;
  const double length[] = {std::sqrt(std::max(0.0, 1 + m[0] - m[4] - m[8])) / 2,
                           std::sqrt(std::max(0.0, 1 - m[0] + m[4] - m[8])) / 2,
                           std::sqrt(std::max(0.0, 1 - m[0] - m[4] + m[8])) / 2};
  const double turn[] = {m[7] - m[5], m[2] - m[6], m[3] - m[1]};
  double q[4] = {0, 0, 0, w};
  for (int i = 0; i < 3; ++i) q[i] = std::copysign(length[i], turn[i]);
  if (w < near) {  // half a turn: the signs follow from the products of two components
    const int largest = int(std::max_element(length, length + 3) - length);
    for (int i = 0; i < 3; ++i)
      q[i] = i == largest ? length[i] : std::copysign(length[i], m[3 * largest + i] + m[3 * i + largest]);
  }
  const double back[] = {
      1 - 2 * (q[1] * q[1] + q[2] * q[2]), 2 * (q[0] * q[1] - q[2] * q[3]),     2 * (q[0] * q[2] + q[1] * q[3]),
      2 * (q[0] * q[1] + q[2] * q[3]),     1 - 2 * (q[0] * q[0] + q[2] * q[2]), 2 * (q[1] * q[2] - q[0] * q[3]),
      2 * (q[0] * q[2] - q[1] * q[3]),     2 * (q[1] * q[2] + q[0] * q[3]),     1 - 2 * (q[0] * q[0] + q[1] * q[1])};
  for (int i = 0; i < 9; ++i) {
    if (!(std::abs(back[i] - m[std::size_t(i)]) <= near)) return "";
  }
  return fmt::format(
      "; that of this matrix, whose columns are the turned axes, is near [{:.9g}, {:.9g}, {:.9g}, {:.9g}]", q[0], q[1],
      q[2], q[3]);
}

/// Reads the parts of a case. Every error names the file, the path of the field, the value and the rule.
class Reader {
 public:
  Reader(const std::string& where, Decimals decimals) : where_(where), decimals_(decimals) {}

  [[noreturn]] void fail(std::string_view path, std::string_view what) const {
    throw BadInput(fmt::format("{}: {} {}", where_, path, what));
  }
  [[noreturn]] void fail(std::string_view path, const json& value, std::string_view rule) const {
    fail(path, fmt::format("is {}: it must be {}", shown(value), rule));
  }
  const json& member(const json& object, std::string_view path, std::string_view name) const {
    const auto found = object.find(name);
    if (found == object.end()) fail(joined(path, name), "is missing");
    return *found;
  }
  void expect_object(const json& j, std::string_view path) const {
    if (!j.is_object()) fail(path.empty() ? "the case" : path, j, "an object");
  }
  template <class Names>
  void expect_only(const json& object, std::string_view path, const Names& names) const {
    for (const auto& item : object.items()) {
      if (std::find(std::begin(names), std::end(names), item.key()) != std::end(names)) continue;
      const std::vector<std::string> expected(std::begin(names), std::end(names));
      const std::string near = nearest_field_text(item.key(), expected);
      fail(joined(path, cut(item.key())),
           fmt::format("is unknown: it must be {}{}{}", fmt::join(expected, ", "), near.empty() ? "" : "; ", near));
    }
  }
  static std::string joined(std::string_view path, std::string_view name) {
    return path.empty() ? std::string(name) : fmt::format("{}.{}", path, name);
  }
  std::string text(const json& j, std::string_view path) const {
    if (!j.is_string()) fail(path, j, "a string");
    const std::string text = j.get<std::string>();
    if (has_control_characters(text)) fail(path, j, "a text without control characters");
    return text;
  }
  std::uint64_t count(const json& j, std::string_view path) const {
    if (!j.is_number_unsigned()) fail(path, j, "an integer that is not negative");
    return j.get<std::uint64_t>();
  }
  double number(const json& j, const std::string& path, Role role, Scalar scalar) const;
  double in_scalar(double x, const std::string& path, Scalar scalar) const;
  void expect_items(const json& j, const std::string& path, std::span<const Child> parts) const;
  std::vector<double> values(const json& j, const Query& query, Scalar scalar) const;
  std::vector<double> counts(const json& inputs, const Query& query) const;
  void expect_count(std::span<const double> numbers, const Query& query, const std::string& path) const;
  void inputs(const json& j, const std::string& path, std::span<const Field> fields, std::size_t prefix, Scalar scalar,
              std::vector<double>& values) const;
  const Query* query(std::string_view name) const;
  Scalar scalar(std::string_view name) const;
  void origin(const json& j, Case& c) const;

 private:
  const std::string& where_;
  const Decimals decimals_;
};

double Reader::number(const json& j, const std::string& path, Role role, Scalar scalar) const {
  if (role == Role::flag) {
    if (!j.is_boolean()) fail(path, j, "true or false");
    return j.get<bool>() ? 1 : 0;
  }
  if (is_discrete(role)) {
    if (!j.is_number_integer()) fail(path, j, "an integer");
    return j.get<double>();
  }
  if (!j.is_number()) fail(path, j, "a number");
  return in_scalar(j.get<double>(), path, scalar);
}

double Reader::in_scalar(double x, const std::string& path, Scalar scalar) const {
  const double nearest = nearest_in(x, scalar);
  if (nearest == x || std::isnan(x)) return x;
  if (std::isinf(nearest)) fail(path, fmt::format("is {}: it must be within the range of {}", x, name_of(scalar)));
  if (nearest == 0)
    fail(path, fmt::format("is {}: it must be a number that {} can tell from zero", x, name_of(scalar)));
  if (decimals_ == Decimals::exact)
    fail(path, fmt::format("is {}: it must be exactly a {}, of which {} is near", x, name_of(scalar), nearest));
  const std::lock_guard lock(counting_rounded);
  ++rounded.count;
  rounded.most = std::max(rounded.most, std::abs(x - nearest));
  return nearest;
}

/// The value is an array of as many items as there are parts.
void Reader::expect_items(const json& j, const std::string& path, std::span<const Child> parts) const {
  std::vector<std::string> names;
  for (const Child& c : parts) names.emplace_back(c.component);
  if (is_quaternion(parts) && j.is_array()) {
    if (const std::vector<double> matrix = matrix_in(j); !matrix.empty())
      fail(path, fmt::format("is a matrix: it must be a quaternion, [x, y, z, w] with w the cosine of half the angle{}",
                             quaternion_text(matrix)));
  }
  if (j.is_array() && j.size() == parts.size()) return;
  const bool numbered = names.front().find_first_not_of("0123456789") == std::string::npos;
  fail(path, j,
       fmt::format("an array of {}{}", parts.size(), numbered ? "" : fmt::format(", [{}]", fmt::join(names, ", "))));
}

/// The numbers in the order of the query; a flag may be 0 or 1.
std::vector<double> Reader::values(const json& j, const Query& query, Scalar scalar) const {
  if (!j.is_array()) fail("values", j, "an array");
  std::vector<double> numbers;
  const auto expect_size = [&] {
    const std::size_t size = query.numbers_of(numbers);
    if (j.size() == size) return;
    const char* of = query.lists.empty() ? "the inputs of the query" : "the inputs of the query with these counts";
    fail("values", fmt::format("has {} numbers: it must have {}, {}", j.size(), size, of));
  };
  if (query.lists.empty()) expect_size();
  while (numbers.size() < query.numbers_of(numbers)) {
    if (numbers.size() == j.size()) expect_size();
    const Field& f = query.fields_of(numbers)[numbers.size()];
    const json& x = j[numbers.size()];
    const std::string path = fmt::format("values[{}], {},", numbers.size(), f.name);
    const bool flag = f.role == Role::flag && x.is_number();
    if (flag && x != 0 && x != 1) fail(path, x, "true, false, 0 or 1");
    const bool whole = f.role != Role::flag && is_discrete(f.role) && x.is_number_float() &&
                       x.get<double>() == std::nearbyint(x.get<double>());
    numbers.push_back(flag || whole ? x.get<double>() : number(x, path, f.role, scalar));
    if (f.role == Role::count) expect_count(numbers, query, path);
  }
  expect_size();
  return numbers;
}

/// The last number is a count that its list can have.
void Reader::expect_count(std::span<const double> numbers, const Query& query, const std::string& path) const {
  const CountedInput& list = list_counted_by_last(query, numbers);
  const double count = numbers.back();
  if (count >= double(list.least) && count <= double(list.most)) return;
  fail(path, fmt::format("is {}: it must be from {} to {}", count, list.least, list.most));
}

/// Numbers of 0 with the counts of the lists in the inputs. Of a list that is no array, the fewest: inputs() tells then
/// what is wrong with it.
std::vector<double> Reader::counts(const json& inputs, const Query& query) const {
  std::vector<double> numbers(query.most_numbers());
  for (std::size_t k = 0; k < query.lists.size(); ++k) {
    const CountedInput& list = query.lists[k];
    const json* j = &inputs;
    for (std::string_view rest = list.name; j != nullptr && !rest.empty();) {
      const std::string_view name = rest.substr(0, rest.find('.'));
      const auto found = j->is_object() ? j->find(name) : j->end();
      j = j->is_object() && found != j->end() ? &*found : nullptr;
      rest.remove_prefix(std::min(rest.size(), name.size() + 1));
    }
    const std::size_t count = j != nullptr && j->is_array() ? j->size() : list.least;
    if (count < list.least || count > list.most) {
      fail("inputs." + list.name, fmt::format("has {} entries: it must have {} to {}", count, list.least, list.most));
    }
    numbers[query.lists.place_of_count(k, numbers)] = double(count);
  }
  numbers.resize(query.numbers_of(numbers));
  return numbers;
}

void Reader::inputs(const json& j, const std::string& path, std::span<const Field> fields, std::size_t prefix,
                    Scalar scalar, std::vector<double>& values) const {
  std::vector<Child> parts = children(fields, prefix);
  const bool is_list = is_counted_list(fields, parts);
  if (is_list) {
    parts.erase(parts.begin());
    values.push_back(double(parts.size()));
  }
  const bool is_vector = is_quaternion(parts) || are_numbers(parts, {"x", "y", "z"});
  const bool array = is_list || (is_vector ? !j.is_object() : is_array(parts));
  if (array) {
    expect_items(j, path, parts);
  } else {
    std::vector<std::string_view> names;
    for (const Child& c : parts) names.push_back(c.component);
    const bool in_a_row = path == "inputs" && j.is_array();
    if (!j.is_object())
      fail(path, j,
           fmt::format("an object with {}{}", fmt::join(names, ", "),
                       in_a_row ? "; numbers in a row are \"values\"" : ""));
    expect_only(j, path, names);
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Child& c = parts[i];
    const json& value = array ? j[i] : member(j, path, c.component);
    const std::string own = joined(path, c.component);
    if (c.leaf) {
      values.push_back(number(value, own, fields[c.begin].role, scalar));
    } else {
      inputs(value, own, fields.subspan(c.begin, c.end - c.begin), below(prefix, c), scalar, values);
    }
  }
}

const Query* Reader::query(std::string_view name) const {
  const Query* q = find_query(name);
  if (q == nullptr) throw BadInput(fmt::format("{}: {}", where_, unknown_query_text(name)));
  return q;
}

Scalar Reader::scalar(std::string_view name) const {
  for (Scalar s : {Scalar::float32, Scalar::float64}) {
    if (name == name_of(s)) return s;
  }
  fail("scalar", json(name), "\"float\" or \"double\"");
}

void Reader::origin(const json& j, Case& c) const {
  expect_object(j, "origin");
  expect_only(j, "origin", std::array{"from", "seed", "index", "moves"});
  if (j.contains("from")) c.origin = text(j["from"], "origin.from");
  if (j.contains("seed")) c.seed = count(j["seed"], "origin.seed");
  if (j.contains("index")) c.index = count(j["index"], "origin.index");
  if (!j.contains("moves")) return;
  if (!j["moves"].is_array()) fail("origin.moves", j["moves"], "an array");
  for (const json& name : j["moves"]) {
    c.moves.push_back(known_mutator(text(name, "origin.moves")));
    if (c.moves.back().empty()) fail("origin.moves", name, "the name of a move");
  }
}

/// Tracks the path of the current value in the document, and rejects input that the library accepts.
class StrictSax : public json::json_sax_t {
 public:
  explicit StrictSax(const std::string& where) : where_(where) {}

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t x, const string_t& text) override {
    const std::string_view digits = std::string_view(text).substr(0, text.find_first_of("eE"));
    if (x == 0 && digits.find_first_of("123456789") != std::string_view::npos) {
      fail(fmt::format("is {}: it must be a number that double can tell from zero", cut(text)));
    }
    return value();
  }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool start_object(std::size_t) override { return open(true); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(false); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    Level& level = levels_.back();
    level.key = name;
    if (has_control_characters(name)) {
      level.key = shown(name);
      fail("is a name with control characters");
    }
    if (!level.seen.insert(name).second) fail("is given twice");
    return true;
  }
  bool parse_error(std::size_t, const std::string& token, const nlohmann::detail::exception& e) override {
    constexpr int number_overflow = 406;
    if (e.id == number_overflow) fail(fmt::format("is {}: it must be within the range of double", cut(token)));
    std::string_view what = e.what();
    what.remove_prefix(std::min(what.size(), what.find("] ") + 2));
    const std::string at = path();
    throw BadInput(fmt::format("{}: {}{}", where_, at.empty() ? "" : "at " + at + ": ", what));
  }

 private:
  struct Level {
    bool object;
    std::string key;
    std::set<std::string> seen;
    std::size_t index = 0;
  };
  std::string path() const {
    std::string p;
    for (const Level& l : levels_) {
      if (l.object && !p.empty() && !l.key.empty()) p += '.';
      p += l.object ? cut(l.key) : fmt::format("[{}]", l.index);
    }
    return p;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw BadInput(fmt::format("{}: {} {}", where_, path(), what));
  }
  bool value() {
    if (!levels_.empty()) ++levels_.back().index;
    return true;
  }
  bool open(bool object) {
    constexpr std::size_t deepest = 64;
    if (levels_.size() == deepest) throw BadInput(fmt::format("{}: nested more than {} deep", where_, deepest));
    levels_.push_back({object, {}, {}});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return value();
  }

  const std::string& where_;
  std::vector<Level> levels_;
};

template <class Bits>
void append_bits(std::vector<std::uint8_t>& bytes, Bits bits) {
  for (std::size_t i = 0; i < sizeof(Bits); ++i) bytes.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
}
template <class Bits>
Bits take_bits(std::span<const std::uint8_t>& bytes) {
  Bits bits = 0;
  for (std::size_t i = 0; i < sizeof(Bits); ++i) bits |= Bits{bytes[i]} << (8 * i);
  bytes = bytes.subspan(sizeof(Bits));
  return bits;
}
double take_number(std::span<const std::uint8_t>& bytes, Role role, Scalar scalar) {
  if (is_discrete(role)) {
    const auto b = static_cast<std::int8_t>(take_bits<std::uint8_t>(bytes));
    return role == Role::flag ? b & 1 : b;
  }
  if (scalar == Scalar::float32) return std::bit_cast<float>(take_bits<std::uint32_t>(bytes));
  return std::bit_cast<double>(take_bits<std::uint64_t>(bytes));
}
std::size_t bytes_of(Role role, Scalar scalar) { return is_discrete(role) ? 1 : scalar == Scalar::float32 ? 4 : 8; }

/// A count that the list can have, for each byte another one of them as far as there are.
double count_of_byte(double byte, const CountedInput& list) {
  if (byte >= double(list.least) && byte <= double(list.most)) return byte;
  return double(list.least + std::size_t(std::abs(byte)) % (list.most - list.least + 1));
}

std::string literal(double value, Role role, Scalar scalar) {
  if (role == Role::flag) return value != 0 ? "true" : "false";
  if (is_discrete(role)) return fmt::format("{:.0f}", value);
  std::string text = scalar == Scalar::float32 ? fmt::format("{}", float(value)) : fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return scalar == Scalar::float32 ? text + "f" : text;
}

std::string cpp_nested(const Case& c, std::size_t begin, std::size_t end, std::size_t prefix) {
  const std::span<const Field> fields = std::span(c.fields()).subspan(begin, end - begin);
  std::vector<Child> parts = children(fields, prefix);
  const bool is_list = is_counted_list(fields, parts), array = is_list || is_array(parts);
  if (is_list) parts.erase(parts.begin());
  std::string text;
  for (const Child& p : parts) {
    if (!text.empty()) text += ", ";
    if (!array) text += fmt::format(".{} = ", p.component);
    const std::size_t at = begin + p.begin;
    text += p.leaf ? literal(c.values[at], c.role(at), c.scalar) : cpp_nested(c, at, begin + p.end, below(prefix, p));
  }
  if (is_list) return fmt::format("{{.count = {}, .entries = {{{{{}}}}}}}", parts.size(), text);
  return "{" + text + "}";
}

}  // namespace

ordered_json fields_to_json(std::span<const Field> fields, std::span<const double> values) {
  return nested(fields, values, 0);
}

ordered_json case_to_json(const Case& c) {
  ordered_json origin;
  origin["from"] = c.origin;
  origin["seed"] = c.seed;
  origin["index"] = c.index;
  origin["moves"] = c.moves;
  ordered_json j;
  j["query"] = c.query->name;
  j["scalar"] = name_of(c.scalar);
  j["inputs"] = fields_to_json(c.fields(), c.values);
  j["origin"] = std::move(origin);
  return j;
}

Decimals decimals_of_users() { return users_decimals; }
void set_decimals_of_users(Decimals rule) { users_decimals = rule; }

const RoundedNumbers& rounded_numbers() { return rounded; }

std::string rounded_numbers_text() {
  if (rounded.count == 0) return "";
  const bool one = rounded.count == 1;
  return fmt::format(
      "{} of case files {} no {}, and {} read as the nearest {}, at most {:.2g} away; --exact refuses {}",
      one ? "1 decimal" : fmt::format("{} decimals", rounded.count), one ? "is" : "are", one ? "float" : "floats",
      one ? "was" : "were", one ? "one" : "ones", rounded.most, one ? "it" : "them");
}

namespace {

Case checked_case(Case c, const std::string& where) {
  if (const auto invalid = c.query->broken(c.values))
    throw BadInput(fmt::format("{}: inputs.{}", where, invalid->text()));
  return c;
}

}  // namespace

Case case_from_json(const json& j, const std::string& where, Decimals decimals) {
  const Reader reader(where, decimals);
  reader.expect_object(j, "");
  reader.expect_only(j, "", std::array{"query", "scalar", "inputs", "values", "origin", "note", "expected", "worst"});
  Case c;
  const json& query = reader.member(j, "", "query");
  if (!query.is_string()) reader.fail("query", query, "a string");
  c.query = reader.query(query.get_ref<const std::string&>());
  c.scalar = reader.scalar(reader.text(reader.member(j, "", "scalar"), "scalar"));
  if (!j.contains("values")) {
    const json& inputs = reader.member(j, "", "inputs");
    const std::vector<Field>& fields =
        c.query->lists.empty() ? c.query->inputs : c.query->fields_of(reader.counts(inputs, *c.query));
    reader.inputs(inputs, "inputs", fields, 0, c.scalar, c.values);
  } else if (j.contains("inputs")) {
    reader.fail("values", "is given beside inputs: one of them must be left out");
  } else {
    c.values = reader.values(j["values"], *c.query, c.scalar);
  }
  if (j.contains("origin")) reader.origin(j["origin"], c);
  return checked_case(std::move(c), where);
}

Case case_from_values(std::string_view query, std::string_view scalar, std::span<const double> values,
                      const std::string& where, Decimals decimals) {
  const Reader reader(where, decimals);
  Case c;
  c.query = reader.query(query);
  c.scalar = reader.scalar(scalar);
  c.values = reader.values(json(values), *c.query, c.scalar);
  return checked_case(std::move(c), where);
}

json parse_json(std::string_view text, const std::string& where) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) throw BadInput(fmt::format("{}: is empty", where));
  StrictSax sax(where);
  json::sax_parse(text, &sax);
  return json::parse(text);
}

Case read_case(const std::filesystem::path& file, Decimals decimals) {
  Case c = case_from_json(parse_json(read_file(file), file.string()), file.string(), decimals);
  if (c.origin.empty()) c.origin = file.filename().string();
  return c;
}

std::string case_to_cpp(const Case& c) {
  return fmt::format(
      "const nearmiss::inputs::{}<{}> question{};\n"
      "const auto answer = nearmiss::adapters::ask_collide<collide::Fast>(question);\n",
      c.query->name, name_of(c.scalar), cpp_nested(c, 0, c.fields().size(), 0));
}

std::vector<std::uint8_t> case_to_bytes(const Case& c) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(1 + 8 * c.values.size());
  bytes.push_back(c.scalar == Scalar::float32 ? 0 : 1);
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (is_discrete(c.role(i))) {
      bytes.push_back(static_cast<std::uint8_t>(static_cast<std::int8_t>(c.values[i])));
    } else if (c.scalar == Scalar::float32) {
      append_bits(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(c.values[i])));
    } else {
      append_bits(bytes, std::bit_cast<std::uint64_t>(c.values[i]));
    }
  }
  return bytes;
}

std::optional<Case> case_from_bytes(const Query& query, std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return std::nullopt;
  Case c;
  c.query = &query;
  c.scalar = (bytes[0] & 1) == 0 ? Scalar::float32 : Scalar::float64;
  c.origin = "bytes";
  bytes = bytes.subspan(1);
  c.values.reserve(query.inputs.size());
  while (c.values.size() < query.numbers_of(c.values)) {
    const Role role = query.fields_of(c.values)[c.values.size()].role;
    if (bytes.size() < bytes_of(role, c.scalar)) return std::nullopt;
    c.values.push_back(take_number(bytes, role, c.scalar));
    if (role == Role::count) c.values.back() = count_of_byte(c.values.back(), list_counted_by_last(query, c.values));
  }
  if (query.broken(c.values)) return std::nullopt;
  return c;
}

}  // namespace nearmiss
