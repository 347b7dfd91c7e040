/// docs/reference/reference-api.md, docs/reference/semantics.md and the catalogue name the same queries.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "corpus/files/source_folder.hpp"
#include "impl/catalogue/query.hpp"
#include "properties/project_files.hpp"

namespace nearmiss {
namespace {

/// A row of a table: the text of its cells, and its section.
struct Row {
  std::string section;
  std::vector<std::string> cells;
};

std::vector<Row> rows_of_reference() {
  const std::string path = source_folder() + "/docs/reference/reference-api.md";
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + " cannot be read");
  std::vector<Row> rows;
  std::string section, line;
  while (std::getline(file, line)) {
    if (line.starts_with("## ")) section = line.substr(3);
    if (!line.starts_with("| `")) continue;
    Row row{section, {}};
    const std::regex cell(R"(\| ([^|]*[^| ]) (?=\|))");
    for (std::sregex_iterator i(line.begin(), line.end(), cell), end; i != end; ++i) row.cells.push_back((*i)[1]);
    rows.push_back(row);
  }
  return rows;
}

bool beyond(const Row& row) { return row.section == "Beyond the reference"; }
std::string quoted(const std::string& cell) {
  return cell.size() > 2 && cell.front() == '`' && cell.back() == '`' ? cell.substr(1, cell.size() - 2) : "";
}
std::string query_of(const Row& row) { return quoted(row.cells[beyond(row) ? 0 : 1]); }

std::vector<Row> rows_of_queries() {
  std::vector<Row> rows = rows_of_reference();
  std::erase_if(rows, [](const Row& row) { return row.section == "What differs everywhere"; });
  return rows;
}

TEST(ReferenceTable, HasRowsOfItsForm) {
  constexpr int functions_of_reference = 45;  // overloads count separately
  const std::vector<Row> rows = rows_of_queries();
  EXPECT_EQ(std::count_if(rows.begin(), rows.end(), [](const Row& row) { return !beyond(row); }),
            functions_of_reference);
  std::set<std::string> seen;
  for (const Row& row : rows) {
    ASSERT_EQ(row.cells.size(), beyond(row) ? 2u : 3u) << row.cells[0];
    EXPECT_FALSE(query_of(row).empty()) << row.cells[0];
    EXPECT_TRUE(seen.insert(row.cells[0]).second) << row.cells[0] << " stands there twice";
    if (beyond(row)) continue;
    EXPECT_TRUE(std::regex_match(row.cells[0], std::regex("`[a-zA-Z]+\\([a-zA-Z0-9, ]+\\)`"))) << row.cells[0];
  }
}

TEST(ReferenceTable, NamesTheSameQueriesAsTheCatalogue) {
  std::set<std::string> named, known, not_in_catalogue, not_in_table;
  for (const Row& row : rows_of_queries()) named.insert(query_of(row));
  for (const Query& query : catalogue()) known.insert(std::string(query.name));
  std::ranges::set_difference(named, known, std::inserter(not_in_catalogue, not_in_catalogue.end()));
  std::ranges::set_difference(known, named, std::inserter(not_in_table, not_in_table.end()));
  EXPECT_TRUE(not_in_catalogue.empty())
      << "docs/reference/reference-api.md names what impl/catalogue/catalogue.def has no line for:\n  "
      << fmt::format("{}", fmt::join(not_in_catalogue, "\n  "));
  EXPECT_TRUE(not_in_table.empty())
      << "docs/reference/reference-api.md has no row for these lines of impl/catalogue/catalogue.def (one that the"
         " reference does not have goes under \"Beyond the reference\"):\n  "
      << fmt::format("{}", fmt::join(not_in_table, "\n  "));
}

/// The first cells of the table below "The queries".
std::set<std::string> queries_with_a_meaning() {
  std::istringstream page(text_of_file("docs/reference/semantics.md"));
  std::set<std::string> queries;
  const std::regex name("`([a-z_]+)`");
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) inside = line == "## The queries";
    if (!inside || !line.starts_with("| `")) continue;
    const std::string cell = line.substr(0, line.find('|', 1));
    for (std::sregex_iterator i(cell.begin(), cell.end(), name), end; i != end; ++i) queries.insert((*i)[1]);
  }
  return queries;
}

TEST(ReferenceTable, EveryQueryOfTheCatalogueHasAMeaning) {
  std::set<std::string> known;
  for (const Query& query : catalogue()) known.insert(std::string(query.name));
  EXPECT_EQ(queries_with_a_meaning(), known) << "docs/reference/semantics.md, The queries";
}

TEST(ReferenceTable, CallsNothingBeyondTheReferenceThatIsInIt) {
  std::set<std::string> of_reference;
  for (const Row& row : rows_of_queries()) {
    if (!beyond(row)) of_reference.insert(query_of(row));
  }
  for (const Row& row : rows_of_queries()) {
    if (!beyond(row)) continue;
    EXPECT_FALSE(of_reference.contains(query_of(row))) << query_of(row);
  }
}

}  // namespace
}  // namespace nearmiss
