/// The links of the project's pages, and the index of the documentation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "properties/project_files.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> pages() {
  std::vector<std::string> pages = project_files();
  std::erase_if(pages, [](const std::string& name) { return !name.ends_with(".md"); });
  return pages;
}

/// The files of the project and their folders.
std::set<std::string> places() {
  std::set<std::string> places;
  for (const std::string& name : project_files()) {
    for (fs::path p = name; !p.empty(); p = p.parent_path()) places.insert(p.string());
  }
  return places;
}

/// The lines of a page outside of blocks of code.
std::vector<std::string> lines_of(const std::string& page) {
  std::vector<std::string> lines;
  std::istringstream text(text_of_file(page));
  bool code = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```")) code = !code;
    if (!code) lines.push_back(line);
  }
  return lines;
}

/// The part after # that leads to a heading: lower case, spaces as hyphens, without punctuation.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) || byte >= 0x80 || c == '-' || c == '_') anchor += char(std::tolower(byte));
    if (c == ' ') anchor += '-';
  }
  return anchor;
}

std::map<std::string, std::set<std::string>> anchors_of_pages() {
  std::map<std::string, std::set<std::string>> anchors;
  for (const std::string& page : pages()) {
    for (const std::string& line : lines_of(page)) {
      const std::size_t text = line.find_first_not_of('#');
      if (line.starts_with("#") && text != std::string::npos) anchors[page].insert(anchor_of(line.substr(text + 1)));
    }
  }
  return anchors;
}

/// The texts in a line that the first group of the expression matches.
std::vector<std::string> matches(const std::string& line, const std::regex& expression) {
  std::vector<std::string> found;
  for (std::sregex_iterator i(line.begin(), line.end(), expression), end; i != end; ++i) found.push_back((*i)[1]);
  return found;
}

struct Link {
  std::string place;   ///< relative to the top of the project
  std::string anchor;  ///< without #; empty for the top of a page
};

/// The links of a line of `page` that lead into the project.
std::vector<Link> links_in(const std::string& line, const std::string& page) {
  static const std::regex target(R"(\]\(([^)\s]+)\))");
  std::vector<Link> links;
  for (const std::string& to : matches(line, target)) {
    if (to.find("://") != std::string::npos) continue;
    const std::size_t hash = std::min(to.find('#'), to.size());
    const fs::path place = hash == 0 ? fs::path(page) : fs::path(page).parent_path() / to.substr(0, hash);
    std::string name = place.lexically_normal().string();
    if (name.ends_with('/')) name.pop_back();
    links.push_back({name, hash == to.size() ? "" : to.substr(hash + 1)});
  }
  return links;
}

TEST(Documentation, EveryLinkLeadsToAHeadingThatExists) {
  const std::set<std::string> known = places();
  const std::map<std::string, std::set<std::string>> anchors = anchors_of_pages();
  std::size_t links = 0;
  for (const std::string& page : pages()) {
    for (const std::string& line : lines_of(page)) {
      for (const Link& link : links_in(line, page)) {
        ++links;
        EXPECT_TRUE(known.contains(link.place)) << page << " links to " << link.place;
        if (link.anchor.empty()) continue;
        const auto at = anchors.find(link.place);
        EXPECT_TRUE(at != anchors.end() && at->second.contains(link.anchor))
            << page << " links to the heading " << link.anchor << " of " << link.place;
      }
    }
  }
  EXPECT_GT(links, 100u);
}

/// The paths in code type whose first folder is one of the project, but for results of runs and for patterns such as
/// `impl/catalogue/queries/QUERY.hpp`.
std::vector<std::string> paths_in(const std::string& line) {
  static const std::regex path(
      "`((?:impl|oracles|corpus|reports|properties|fuzz|benchmarks|docs|cmake)/[A-Za-z0-9_./-]*[A-Za-z0-9])/?`");
  static const std::regex not_a_file("^reports/runs|[A-Z]{2,}(?!\\w*\\.md)");
  std::vector<std::string> paths = matches(line, path);
  std::erase_if(paths, [](const std::string& name) { return std::regex_search(name, not_a_file); });
  return paths;
}

TEST(Documentation, EveryPathNamesAFileThatExists) {
  const std::set<std::string> known = places();
  std::size_t paths = 0;
  for (const std::string& page : pages()) {
    for (const std::string& line : lines_of(page)) {
      for (const std::string& name : paths_in(line)) {
        EXPECT_TRUE(known.contains(name)) << page << " names " << name;
        ++paths;
      }
    }
  }
  EXPECT_GT(paths, 100u);
}

TEST(Documentation, TheIndexNamesEveryPage) {
  const std::string index = "docs/README.md";
  std::set<std::string> expected, named;
  for (const std::string& page : pages()) {
    if (page.starts_with("docs/") && page != index) expected.insert(page);
  }
  for (const std::string& line : lines_of(index)) {
    for (const Link& link : links_in(line, index)) {
      if (link.place.starts_with("docs/")) named.insert(link.place);
    }
  }
  EXPECT_EQ(named, expected);
}

/// A page of docs/measured says at its top how it is written, so that nobody edits it.
TEST(Documentation, EveryMeasuredPageNamesItsCommand) {
  std::size_t measured = 0;
  for (const std::string& page : pages()) {
    if (!page.starts_with("docs/measured/")) continue;
    ++measured;
    const std::string top = text_of_file(page).substr(0, 1000);
    EXPECT_TRUE(std::regex_search(top, std::regex("Written by|writes the page"))) << page;
  }
  EXPECT_GE(measured, 13u);
}

}  // namespace
}  // namespace nearmiss
