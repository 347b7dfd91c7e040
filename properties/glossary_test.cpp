/// The glossary (docs/reference/glossary.md) and the types of the code: one name, one thing.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "properties/project_files.hpp"

namespace nearmiss {
namespace {

constexpr const char* glossary = "docs/reference/glossary.md";

using Row = std::vector<std::string>;

Row cells_of(const std::string& line) {
  Row cells;
  std::istringstream in(line.substr(1));
  for (std::string cell; std::getline(in, cell, '|');) {
    const std::size_t begin = cell.find_first_not_of(' '), end = cell.find_last_not_of(' ');
    cells.push_back(begin == std::string::npos ? "" : cell.substr(begin, end + 1 - begin));
  }
  return cells;
}

/// The rows of the table of the glossary with this header, without the header.
std::vector<Row> rows_below(const std::string& header) {
  std::vector<Row> rows;
  std::istringstream in(text_of_file(glossary));
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (inside && line.starts_with("| ")) rows.push_back(cells_of(line));
    inside = line == header || (inside && line.starts_with("|"));
  }
  return rows;
}

/// The texts in code type.
std::vector<std::string> names_in(const std::string& cell) {
  std::vector<std::string> names;
  std::istringstream in(cell);
  std::string part;
  for (bool code = false; std::getline(in, part, '`'); code = !code) {
    if (code) names.push_back(part);
  }
  return names;
}

bool is_part_of_a_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// The type that a line declares and defines outside of any other type; empty for all other lines.
std::string type_in(std::string_view line) {
  for (const std::string_view keyword : {"struct ", "class ", "enum class ", "enum ", "union ", "concept ", "using "}) {
    if (!line.starts_with(keyword)) continue;
    line.remove_prefix(keyword.size());
    if (line.starts_with("[[")) line.remove_prefix(std::min(line.find("]] ") + 3, line.size()));
    const auto end = std::find_if_not(line.begin(), line.end(), is_part_of_a_name);
    const std::string name(line.begin(), end);
    const std::string_view rest = line.substr(name.size());
    const bool defines = rest.starts_with(" =") || rest.find('{') != std::string_view::npos || !rest.ends_with(';');
    if (name == "class" || name == "namespace" || rest.starts_with("<") || rest.starts_with("::") || !defines) continue;
    return name;
  }
  return "";
}

struct Code {
  std::map<std::string, std::vector<std::string>> types;  ///< and the files that define them
  std::string headers;                                    ///< their text
  std::set<std::string> places;                           ///< files and folders
};

void add_places(const std::string& file, std::set<std::string>& places) {
  places.insert(file);
  for (std::size_t slash = file.find('/'); slash != std::string::npos; slash = file.find('/', slash + 1))
    places.insert(file.substr(0, slash));
}

Code read_code() {
  Code code;
  for (const std::string& file : project_files()) {
    add_places(file, code.places);
    if (!(file.ends_with(".cpp") || file.ends_with(".hpp")) || file.find("/overlay/") != std::string::npos) continue;
    const std::string text = text_of_file(file);
    if (file.ends_with(".hpp")) code.headers += text;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
      if (const std::string type = type_in(line); !type.empty()) code.types[type].push_back(file);
    }
  }
  return code;
}

const Code& code() {
  static const Code read = read_code();
  return read;
}

std::string last_part(const std::string& name) {
  const std::size_t colons = name.rfind("::");
  return colons == std::string::npos ? name : name.substr(colons + 2);
}

/// True for a file or a folder, for a function of a header, `name()`, and for a type.
bool exists(const std::string& name) {
  if (name.find('/') != std::string::npos) return code().places.contains(name);
  if (name.ends_with("()")) return code().headers.find(' ' + name.substr(0, name.size() - 1)) != std::string::npos;
  return code().types.contains(last_part(name));
}

/// "WorstCase" for "worst case".
std::string type_of_word(const std::string& word) {
  std::string type;
  bool begins = true;
  for (const char c : word) {
    if (is_part_of_a_name(c)) type += begins ? char(std::toupper(static_cast<unsigned char>(c))) : c;
    begins = !is_part_of_a_name(c);
  }
  return type;
}

/// "scene", "ranges" for "SceneRanges".
std::vector<std::string> words_of_type(const std::string& type) {
  std::vector<std::string> words;
  for (const char c : type) {
    const bool begins = std::isupper(static_cast<unsigned char>(c)) || c == '_';
    if (begins || words.empty()) words.emplace_back();
    if (c != '_') words.back() += char(std::tolower(static_cast<unsigned char>(c)));
  }
  return words;
}

const std::vector<Row>& entries() {
  static const std::vector<Row> rows = rows_below("| word | meaning | in the code |");
  return rows;
}

TEST(Glossary, EveryWordIsInTheCode) {
  EXPECT_GT(entries().size(), 60u);
  for (const Row& row : entries()) {
    ASSERT_EQ(row.size(), 3u) << row[0];
    const std::vector<std::string> names = names_in(row[2]);
    EXPECT_FALSE(names.empty()) << row[0] << " names nothing of the code";
    for (const std::string& name : names) EXPECT_TRUE(exists(name)) << row[0] << ": there is no " << name;
  }
}

/// Of a type that is named like a word there is one, or as many as the word's entry names.
TEST(Glossary, OneTypeHasTheNameOfAWord) {
  std::size_t types = 0;
  for (const Row& row : entries()) {
    std::istringstream words(row[0]);
    for (std::string word; std::getline(words, word, ',');) {
      const std::string type = type_of_word(word);
      const auto known = code().types.find(type);
      if (known == code().types.end()) continue;
      const std::vector<std::string> names = names_in(row[2]);
      const auto named = std::count_if(names.begin(), names.end(), [&](auto& name) { return last_part(name) == type; });
      EXPECT_EQ(known->second.size(), std::size_t(named)) << type << " in " << testing::PrintToString(known->second);
      ++types;
    }
  }
  EXPECT_GT(types, 30u);
}

/// A word that had several meanings: the glossary lists every type whose name has it, so that a new one is looked at.
TEST(Glossary, TypesUseAWordInItsMeaning) {
  const std::vector<Row> rows = rows_below("| word | types |");
  EXPECT_GE(rows.size(), 5u);
  for (const Row& row : rows) {
    ASSERT_EQ(row.size(), 2u);
    const std::vector<std::string> names = names_in(row[1]);
    std::set<std::string> found;
    for (const auto& [type, files] : code().types) {
      const std::vector<std::string> words = words_of_type(type);
      if (std::ranges::any_of(words, [&](const std::string& word) { return word.starts_with(row[0]); }))
        found.insert(type);
    }
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()), found) << "types with the word " << row[0];
  }
}

}  // namespace
}  // namespace nearmiss
