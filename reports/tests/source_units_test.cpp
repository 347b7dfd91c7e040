/// The parts of sources of which emitted tests are made.
#include "reports/upstream/source_units.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace nearmiss {
namespace {

using Words = std::vector<std::string>;

/// The texts of the units that the words need, or the names of all units.
Words needed(const std::vector<SourceUnit>& units, const std::set<std::string>& words) {
  const std::vector<bool> chosen = needed_units(units, words);
  Words texts;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (chosen[i]) texts.push_back(units[i].text);
  }
  return texts;
}
Words names(const std::vector<SourceUnit>& units) {
  Words all;
  for (const SourceUnit& u : units) all.insert(all.end(), u.names.begin(), u.names.end());
  return all;
}

TEST(SourceUnits, OfJavascriptDeclareTheirNames) {
  const auto units = units_of(R"(import fs, { a as b } from "x";
const { version, library: { C } } = await load("y"), [, d] = e(), f = { g: 1 };
export async function h({ i, j: k }, l = m) { const n = `}${i}`; return n; }
class O { constructor(p) { this.p = p; } }
const q = s.replace(/[^/}]+\/(.)/, "{"), r = 2;
q.t(r);
)",
                              Language::javascript);
  EXPECT_EQ(names(units), (Words{"fs", "b", "version", "C", "d", "f", "h", "O", "q", "r"}));
  ASSERT_EQ(units.size(), 6u);
  EXPECT_TRUE(units[5].names.empty());
  EXPECT_FALSE(units[2].words.contains("i")) << "a parameter";
  EXPECT_FALSE(units[2].words.contains("n")) << "a local variable";
  EXPECT_TRUE(units[2].words.contains("m")) << "a default value";
  EXPECT_FALSE(units[3].words.contains("p"));
  EXPECT_FALSE(units[4].words.contains("replace")) << "a member";
}

TEST(SourceUnits, OfCppDeclareTheirNames) {
  const auto units = units_of(R"(#include <x.h>

namespace {

using Name::A, Name::B;
using C = D<int>;
constexpr int e = 1, f[] = {2, 3};
/// The comment.
template <int g(const double*), class H>
int i(const H& h) {
  return g(h.j) + 1'000;  // }
}
struct K : L {
  int m = 0;
};

}  // namespace

extern "C" int n(void) { return e; }
)",
                              Language::cpp);
  EXPECT_EQ(names(units), (Words{"#include <x.h>", "A", "B", "C", "e", "f", "i", "K", "extern"}));
  ASSERT_EQ(units.size(), 7u);
  EXPECT_EQ(units[4].comment, "/// The comment.\n");
  EXPECT_TRUE(units[4].text.ends_with("\n}")) << units[4].text;
}

/// What prepares the library is needed always, another statement only with what it mentions.
TEST(SourceUnits, AreNeededWithWhatTheyMention) {
  const auto units = units_of(R"(const lib = start();
const settings = 1;
lib.prepare(settings);

// Shapes.
const ball = lib.ball();
const mesh = lib.mesh();
lib.fill(mesh);
const pair = () => [ball, other];
)",
                              Language::javascript);
  const Words head{"const lib = start();", "const settings = 1;", "lib.prepare(settings);"};
  const auto with_head = [&](const Words& more) {
    Words all = head;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  EXPECT_EQ(needed(units, {}), head);
  EXPECT_EQ(needed(units, {"pair"}), with_head({"const ball = lib.ball();", "const pair = () => [ball, other];"}));
  EXPECT_EQ(needed(units, {"mesh"}), with_head({"const mesh = lib.mesh();", "lib.fill(mesh);"}));
}

TEST(SourceUnits, AreCutAndChangedWordByWord) {
  EXPECT_EQ(items_of_list(R"(f(a, [b, "]"]), { c: d, e }) + g)", Language::javascript),
            (Words{R"(f(a, [b, "]"]))", "{ c: d, e }"}));
  EXPECT_EQ(items_of_list(R"("q", of<a, 4>, 0})", Language::cpp, true), (Words{R"("q")", "of<a, 4>", "0"}));
  EXPECT_EQ(with_words(R"(SETTING != "SETTING"  // SETTING)", Language::cpp, {{"SETTING", R"("x")"}}),
            R"("x" != "SETTING"  // SETTING)");
  const std::string table = R"({ ab: 1, b: 2 })";
  EXPECT_EQ(table.substr(behind_name(table, Language::javascript, "b", ':')), " 2 }");
  EXPECT_EQ(behind_name(table, Language::javascript, "a", ':'), std::string::npos);
}

}  // namespace
}  // namespace nearmiss
