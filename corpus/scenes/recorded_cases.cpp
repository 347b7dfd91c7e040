#include "corpus/scenes/recorded_cases.hpp"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <string_view>

#include "corpus/storage/codec.hpp"

namespace nearmiss::scenes {

namespace {

/// Calls `each` with every line that is not blank, and with where it is: "FILE:3".
template <class Each>
void for_each_line(const std::filesystem::path& file, const Each& each) {
  const std::string text = read_file(file);
  std::string_view rest = text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // a byte order mark of UTF-8
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::size_t end = rest.find('\n');
    std::string_view line = rest.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (line.find_first_not_of(" \t") != std::string_view::npos)
      each(line, number, fmt::format("{}:{}", file.string(), number));
  }
}

std::vector<std::string_view> cells_of(std::string_view row) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = row.find(',');
    std::string_view cell = row.substr(0, comma);
    while (!cell.empty() && cell.front() == ' ') cell.remove_prefix(1);
    while (!cell.empty() && cell.back() == ' ') cell.remove_suffix(1);
    cells.push_back(cell);
    if (comma == std::string_view::npos) return cells;
    row.remove_prefix(comma + 1);
  }
}

Case case_of_row(std::string_view row, const std::string& where) {
  const std::vector<std::string_view> cells = cells_of(row);
  if (cells.size() < 2) throw BadInput(fmt::format("{}: 1 column: a row begins with query and scalar", where));
  std::vector<double> numbers;
  for (std::size_t i = 2; i < cells.size(); ++i) {
    double x = 0;
    const auto [end, error] = std::from_chars(cells[i].data(), cells[i].data() + cells[i].size(), x);
    if (error != std::errc() || end != cells[i].data() + cells[i].size())
      throw BadInput(fmt::format("{}: column {} is \"{}\": it must be a number", where, i + 1, cells[i]));
    numbers.push_back(x);
  }
  return case_from_values(cells[0], cells[1], numbers, where, decimals_of_users());
}

/// Notes where each case is from.
void append(std::vector<Case>& all, Case c, const std::filesystem::path& file, std::size_t line) {
  c.origin = fmt::format("{}:{}", file.filename().string(), line);
  c.index = all.size();
  all.push_back(std::move(c));
}

std::vector<Case> not_empty(std::vector<Case> all, const std::filesystem::path& file) {
  if (all.empty()) throw BadInput(fmt::format("{}: it has no case", file.string()));
  return all;
}

}  // namespace

std::vector<Case> read_json_lines(const std::filesystem::path& file) {
  std::vector<Case> all;
  for_each_line(file, [&](std::string_view line, std::size_t number, const std::string& where) {
    append(all, case_from_json(parse_json(line, where), where, decimals_of_users()), file, number);
  });
  return not_empty(std::move(all), file);
}

std::vector<Case> read_csv(const std::filesystem::path& file) {
  std::vector<Case> all;
  for_each_line(file, [&](std::string_view line, std::size_t number, const std::string& where) {
    if (number == 1 && line.starts_with("query,")) return;
    append(all, case_of_row(line, where), file, number);
  });
  return not_empty(std::move(all), file);
}

std::string json_lines(const std::vector<Case>& cases) {
  std::string text;
  for (const Case& c : cases) {
    nlohmann::ordered_json j;
    j["query"] = c.query->name;
    j["scalar"] = name_of(c.scalar);
    j["values"] = c.values;
    text += j.dump() + "\n";
  }
  return text;
}

}  // namespace nearmiss::scenes
