/// The direction of includes: a folder includes only itself and folders to its left in the order of
/// docs/explanation/architecture.md. An oracle includes nothing of the implementation but shapes, answers and their
/// members.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/files/source_folder.hpp"
#include "impl/adapters/decisive_kernels.hpp"
#include "impl/catalogue/query.hpp"
#include "properties/project_files.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;

const fs::path root = source_folder();
constexpr std::string_view collide_headers = "impl/collide/include/", collide_sources = "impl/collide/source/";

/// Folders of the same rank do not include each other.
struct Room {
  std::string_view folder;
  int rank;
};
constexpr Room rooms[] = {
    {"impl/collide", 0},
    {"impl/catalogue", 1},
    {"impl/plugin", 1},
    {"impl/engines", 2},
    {"impl/subject", 2},
    {"impl/adapters", 3},
    {"impl/builds", 4},
    {"impl/host", 3},
    {"oracles/exact", 4},
    {"oracles/algorithms", 5},
    {"oracles", 6},
    {"corpus/files", 7},
    {"corpus/field-causes", 7},
    {"corpus/generator", 7},
    {"corpus/storage", 8},
    {"corpus/importers", 9},
    {"corpus/relations", 9},
    {"corpus/scenes", 9},
    {"corpus/search", 9},
    {"reports/findings", 10},
    {"reports/engine", 11},
    {"reports/picture", 11},
    {"reports/triage/causes", 12},
    {"reports/triage/geometry", 12},
    {"reports/triage/trials", 13},
    {"reports/triage/hypotheses", 14},
    {"reports/triage/minimisation", 14},
    {"reports/triage/examination", 15},
    {"reports/triage", 16},
    {"reports/triage/comparison", 17},
    {"reports/trade", 12},
    {"reports/advice", 18},
    {"reports/builds", 18},
    {"reports/upstream", 18},
    {"reports/page", 18},
    {"reports/commands", 19},
    {"properties/judge", 19},
    {"reports/tests", 20},
    {"properties", 20},
    {"fuzz", 20},
    {"benchmarks", 20},
};

/// The innermost folder of the list that contains the file.
const Room& room_of(const std::string& file) {
  const Room* found = nullptr;
  for (const Room& r : rooms) {
    const bool within = file.starts_with(std::string(r.folder) + "/");
    if (within && (found == nullptr || r.folder.size() > found->folder.size())) found = &r;
  }
  if (found == nullptr) throw std::runtime_error(file + " is in no room");
  return *found;
}

bool is_source(const fs::path& p) {
  return p.extension() == ".cpp" || p.extension() == ".hpp" || p.extension() == ".h";
}

/// Each source and header of the project in a folder of the list, without the overlay of another query.
std::vector<std::string> sources() {
  std::set<std::string> tops;
  for (const Room& r : rooms) tops.insert(std::string(r.folder.substr(0, r.folder.find('/'))));
  std::vector<std::string> files;
  for (const std::string& name : project_files()) {
    const bool within = tops.contains(name.substr(0, name.find('/')));
    if (within && is_source(name) && name.find("/overlay/") == std::string::npos && fs::exists(root / name))
      files.push_back(name);
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The project file that an include names; empty for files outside the project or made by CMake.
std::optional<std::string> named_by(std::string_view line) {
  if (!line.starts_with("#include ")) return std::nullopt;
  const char open = line[9];
  const std::size_t end = line.find(open == '<' ? '>' : '"', 10);
  if ((open != '<' && open != '"') || end == std::string_view::npos) return std::nullopt;
  std::string name(line.substr(10, end - 10));
  if (name.starts_with("collide/")) name.insert(0, collide_headers);
  return fs::exists(root / name) ? std::optional(name) : std::nullopt;
}

std::vector<std::string> includes_of(const std::string& file) {
  std::ifstream in(root / file);
  std::vector<std::string> found;
  for (std::string line; std::getline(in, line);) {
    if (const auto name = named_by(line)) found.push_back(*name);
  }
  return found;
}

TEST(Structure, IncludesPointToTheLeft) {
  const std::vector<std::string> files = sources();
  ASSERT_GT(files.size(), 200u);
  std::size_t includes = 0;
  for (const std::string& file : files) {
    const Room& own = room_of(file);
    for (const std::string& other : includes_of(file)) {
      const Room& theirs = room_of(other);
      ++includes;
      EXPECT_TRUE(own.folder == theirs.folder || theirs.rank < own.rank) << file << " includes " << other;
    }
  }
  EXPECT_GT(includes, 500u);
}

/// The headers of the library that an oracle may include: shapes, inputs and answers.
TEST(Structure, NoOracleSeesTheImplementation) {
  const std::set<std::string> vocabulary{"answers.hpp",      "members.hpp",    "shapes.hpp", "strict_begin.hpp",
                                         "strict_check.hpp", "strict_end.hpp", "vec3.hpp"};
  for (const std::string& file : sources()) {
    if (!file.starts_with("oracles/exact/") && !file.starts_with("oracles/algorithms/")) continue;
    std::vector<std::string> reached{file};
    for (std::size_t i = 0; i < reached.size(); ++i) {
      for (const std::string& other : includes_of(reached[i])) {
        if (std::find(reached.begin(), reached.end(), other) == reached.end()) reached.push_back(other);
      }
    }
    for (const std::string& other : reached) {
      if (!other.starts_with("impl/collide/")) continue;
      EXPECT_TRUE(vocabulary.contains(fs::path(other).filename().string())) << file << " reaches " << other;
    }
  }
}

/// `collide` includes nothing but itself.
TEST(Structure, TheLibraryKnowsNothingOfItsExaminers) {
  for (const std::string& file : sources()) {
    if (!file.starts_with("impl/collide/")) continue;
    const std::string text = text_of_file(file);
    for (const char* word : {"nearmiss", "judge", "harness", "oracle", "fuzz", " ask(", "ask<"}) {
      EXPECT_EQ(text.find(word), std::string::npos) << file << ": " << word;
    }
    for (const std::string& other : includes_of(file)) EXPECT_TRUE(other.starts_with("impl/collide/")) << file;
  }
}

/// The umbrella header includes every public header but itself, those of batches and those that need more than the
/// standard library.
TEST(Structure, TheUmbrellaHeaderIncludesEveryPublicHeader) {
  const std::string folder = std::string(collide_headers) + "collide/";
  std::set<std::string> expected, included;
  for (const std::string& file : sources()) {
    if (fs::path(file).parent_path() == fs::path(folder).parent_path()) expected.insert(file);
  }
  for (const char* other : {"batch.hpp", "certified.hpp", "collide.hpp", "decisive.hpp", "soa.hpp"})
    ASSERT_EQ(expected.erase(folder + other), 1u) << other;
  for (const std::string& file : includes_of(folder + "collide.hpp")) included.insert(file);
  EXPECT_EQ(included, expected);
}

/// Only the library and the tests of its parts include what may change without notice.
TEST(Structure, DetailsOfTheLibraryStayInside) {
  const std::set<std::string> tests_of_details{"properties/numbers_test.cpp"};
  for (const std::string& file : sources()) {
    if (file.starts_with("impl/collide/") || tests_of_details.contains(file)) continue;
    for (const std::string& other : includes_of(file)) {
      EXPECT_EQ(other.find("/detail/"), std::string::npos) << file;
      EXPECT_FALSE(other.starts_with(collide_sources)) << file;
    }
  }
}

/// Each header with arithmetic turns contraction off around it.
TEST(Structure, EveryKernelIsCompiledStrictly) {
  const std::string detail = std::string(collide_headers) + "collide/detail/";
  std::size_t kernels = 0;
  for (const std::string& file : sources()) {
    const bool of_library = file.starts_with(collide_sources) && file.ends_with(".hpp");
    if (!(file.starts_with(detail) || of_library) || file.find("/strict_") != std::string::npos) continue;
    if (file == detail + "refuse_argument.hpp") continue;  // it computes nothing
    const std::vector<std::string> included = includes_of(file);
    EXPECT_EQ(std::count(included.begin(), included.end(), detail + "strict_begin.hpp"), 1) << file;
    ASSERT_FALSE(included.empty());
    EXPECT_EQ(included.back(), detail + "strict_end.hpp") << file;
    ++kernels;
  }
  EXPECT_GT(kernels, 43u);
}

/// A program that calls a compiled tier reads nothing that the library alone needs: numbers with bounds, exact numbers,
/// GMP, MPFR, and the intrinsics of all processors.
TEST(Structure, NoHeaderReadsWhatTheLibraryCompiles) {
  std::size_t headers = 0;
  for (const std::string& file : sources()) {
    if (!file.starts_with(collide_headers)) continue;
    ++headers;
    const std::string text = text_of_file(file);
    for (const char* heavy : {"gmp.h", "mpfr.h", "immintrin.h"}) {
      if (file.ends_with("/batch_avx2.hpp")) continue;  // only batch.hpp includes it
      EXPECT_EQ(text.find("#include <" + std::string(heavy)), std::string::npos) << file << ": " << heavy;
    }
    for (const std::string& other : includes_of(file)) EXPECT_TRUE(other.starts_with(collide_headers)) << file;
  }
  EXPECT_GT(headers, 86u);
}

/// The library's table, from which its sources are written, has every query, and the tier Decisive where that has a
/// kernel.
TEST(Structure, EveryQueryIsInTheTableOfTheLibrary) {
  std::map<std::string, bool> expected, found;  // by query: in Decisive too
  for (const Query& q : catalogue()) expected[std::string(q.name)] = adapters::has_decisive_kernel(q.name);
  std::istringstream table(text_of_file(std::string(collide_sources) + "queries.txt"));
  for (std::string line; std::getline(table, line);) {
    if (line.starts_with("#")) continue;
    std::istringstream words(line);
    std::string tiers, answer, function;
    words >> tiers >> answer >> function;
    EXPECT_TRUE(tiers == "Certified" || tiers == "Certified,Decisive") << line;
    found[function.substr(0, function.find('('))] = tiers == "Certified,Decisive";
  }
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace nearmiss
