/// The generator: its cases are valid, exact, the same on every machine, and useful.
#include "corpus/generator/generator.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

class Generator : public testing::TestWithParam<NamedQuery> {};

/// Hash of the case and its mutators (FNV-1a over the bytes that the codec defines).
std::uint64_t hashed(std::uint64_t h, const Case& c) {
  const auto add = [&](unsigned char byte) { h = (h ^ byte) * 0x100000001b3; };
  for (std::uint8_t byte : case_to_bytes(c)) add(byte);
  for (std::string_view move : c.moves) {
    for (char letter : move) add(static_cast<unsigned char>(letter));
  }
  return h;
}

std::string stream_hash(const Query& query, Scalar scalar) {
  constexpr std::uint64_t cases = 1000;
  std::uint64_t h = 0xcbf29ce484222325;
  for (std::uint64_t i = 0; i < cases; ++i) h = hashed(h, generate(query, scalar, 1, i));
  return fmt::format("{:016x}", h);
}

TEST_P(Generator, MakesCasesThatAreValidAndExactInTheirScalar) {
  const Query& query = *GetParam().query;
  for (Scalar scalar : scalars) {
    for (std::uint64_t i = 0; i < 20000; ++i) {
      const Case c = generate(query, scalar, 7, i);
      ASSERT_EQ(c.values.size(), query.inputs.size());
      const auto invalid = query.broken(c.values);
      ASSERT_FALSE(invalid) << "case " << i << ": " << invalid->text();
      for (double x : c.values) ASSERT_TRUE(representable(x, scalar)) << "case " << i << ": " << x;
    }
  }
}

TEST_P(Generator, KeepsToModerateMagnitudes) {
  const Query& query = *GetParam().query;
  for (Scalar scalar : scalars) {
    const double largest = scalar == Scalar::float32 ? 0x1p18 : 0x1p60;
    for (std::uint64_t i = 0; i < 20000; ++i) {
      const Case c = generate(query, scalar, 7, i);
      if (has_extreme_mutator(c)) continue;
      for (double x : c.values) ASSERT_LE(std::abs(x), largest) << "case " << i;
    }
  }
}

TEST_P(Generator, GivesTheSameCaseWhateverWasMadeBefore) {
  const Query& query = *GetParam().query;
  Case reused;
  for (std::uint64_t i : {5, 0, 99, 5}) {
    generate(reused, query, Scalar::float64, 3, i);
    const Case fresh = generate(query, Scalar::float64, 3, i);
    EXPECT_EQ(reused.values, fresh.values);
    EXPECT_EQ(reused.moves, fresh.moves);
    EXPECT_EQ(reused.index, i);
  }
}

TEST_P(Generator, GivesAnotherCaseForEverySeedAndIndex) {
  const Query& query = *GetParam().query;
  std::set<std::vector<double>> seen;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    for (std::uint64_t i = 0; i < 30; ++i) seen.insert(generate(query, Scalar::float64, seed, i).values);
  }
  EXPECT_EQ(seen.size(), 900u);
}

/// A decision that is nearly always the same makes every agreement worthless.
TEST_P(Generator, MixesYesAndNo) {
  const Query& query = *GetParam().query;
  if (!decides(query.kind)) GTEST_SKIP() << "the answer is always yes";
  // Scenes place boxes so that they nearly touch, and then their bounding spheres overlap.
  const int least = query.name == "box_box_conservative" ? 8 : 15;
  constexpr int cases = 4000;
  for (Scalar scalar : scalars) {
    int yes = 0;
    for (std::uint64_t i = 0; i < cases; ++i) yes += truth_is_yes(generate(query, scalar, 1, i));
    EXPECT_GE(yes, cases * least / 100) << "hits of " << cases << " in " << name_of(scalar);
    EXPECT_LE(yes, cases * (100 - least) / 100) << "hits of " << cases << " in " << name_of(scalar);
  }
}

TEST_P(Generator, MakesHalfOfTheCasesScenesAndTheOthersByMoves) {
  const Query& query = *GetParam().query;
  constexpr int cases = 4000;
  int scenes = 0;
  for (std::uint64_t i = 0; i < cases; ++i) scenes += generate(query, Scalar::float64, 1, i).moves.empty();
  EXPECT_GE(scenes, cases * 40 / 100);
  EXPECT_LE(scenes, cases * 65 / 100);
}

TEST_P(Generator, MutatesIntoAnotherValidCase) {
  const Query& query = *GetParam().query;
  for (Scalar scalar : scalars) {
    int changed = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const Case before = generate(query, scalar, 1, i);
      Case after = before;
      mutate(after, i);
      ASSERT_FALSE(query.broken(after.values));
      for (double x : after.values) ASSERT_TRUE(representable(x, scalar));
      changed += after.values != before.values;
    }
    EXPECT_GE(changed, 1000);
  }
}

INSTANTIATE_FOR_EVERY_QUERY(Every, Generator, testing::ValuesIn(every_query()), testing::PrintToStringParamName());

/// A query that the catalogue does not have: a rule between two positions, as for a box given by its corners.
const Query& corners_query() {
  static const Query made_up = [] {
    Query q{QueryId{}, "corners", Kind::decision, {}, {}, {}, {}, nullptr, {}};
    q.operands = operands_of({{"box", Shape::aabox, Role::inherited, 6}});
    for (const char* name : {"box.min.x", "box.min.y", "box.min.z", "box.max.x", "box.max.y", "box.max.z"}) {
      q.inputs.push_back({name, Role::position});
    }
    q.broken = [](std::span<const double> v) -> std::optional<Invalid> {
      for (std::size_t i = 0; i < 3; ++i) {
        if (v[i] > v[i + 3]) return Invalid{"box.min", v[i], "at most max"};
      }
      return std::nullopt;
    };
    return q;
  }();
  return made_up;
}

TEST(GeneratorOfAnyQuery, TriesAgainUntilTheRulesHold) {
  for (Scalar scalar : scalars) {
    for (std::uint64_t i = 0; i < 2000; ++i) {
      Case c = generate(corners_query(), scalar, 1, i);
      ASSERT_FALSE(corners_query().broken(c.values)) << "case " << i;
      mutate(c, i);
      ASSERT_FALSE(corners_query().broken(c.values)) << "case " << i << ", mutated";
    }
  }
}

TEST(Moves, AreNamedOnceAndKnownByTheirNames) {
  std::set<std::string_view> names;
  for (const MutatorName& m : mutator_names()) {
    EXPECT_TRUE(names.insert(m.name).second) << m.name;
    EXPECT_EQ(known_mutator(m.name), m.name);
    EXPECT_FALSE(m.what.empty());
  }
  EXPECT_TRUE(known_mutator("no-such-move").empty());
}

TEST(Moves, AreEachUsedForSomeQuery) {
  std::map<std::string_view, int> used;
  constexpr int cases = 2000;
  for (const Query& q : catalogue()) {
    std::map<std::string_view, int> here;
    for (std::uint64_t i = 0; i < cases; ++i) {
      for (std::string_view m : generate(q, Scalar::float64, 1, i).moves) ++here[m];
    }
    for (const auto& [name, count] : here) used[name] = std::max(used[name], count);
  }
  for (const MutatorName& m : mutator_names()) EXPECT_GE(used[m.name], cases / 100) << m.name;
}

/// properties/streams.txt: query, scalar and the hash of the first 1000 cases of seed 1. Rewritten with
/// NEARMISS_WRITE_STREAMS=1 after an intended change of the generator.
class Streams : public testing::Test {
 protected:
  static std::filesystem::path file() { return source_folder() + "/properties/streams.txt"; }
};

TEST_F(Streams, AreTheSameOnEveryMachineAndCompiler) {
  std::string now;
  for (const Query& q : catalogue()) {
    for (Scalar s : scalars) now += fmt::format("{} {} {}\n", q.name, name_of(s), stream_hash(q, s));
  }
  if (std::getenv("NEARMISS_WRITE_STREAMS") != nullptr) write_file(file(), now);
  std::ifstream stored(file());
  ASSERT_TRUE(stored) << file();
  int lines = 0;
  for (std::string line; std::getline(stored, line); ++lines) {
    EXPECT_NE(now.find(line + '\n'), std::string::npos) << "stored: " << line << "\nnow:\n" << now;
  }
  EXPECT_GE(lines, 14);
}

/// The words in code type in the row of docs/triage.md about moves.
std::vector<std::string> moves_of_the_triage_page() {
  std::ifstream page(source_folder() + "/docs/triage.md");
  std::vector<std::string> names;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| `origin.moves` |")) continue;
    for (std::size_t open = line.find("| ", 2); (open = line.find('`', open + 1)) != std::string::npos;) {
      const std::size_t close = line.find('`', open + 1);
      names.push_back(line.substr(open + 1, close - open - 1));
      open = close;
    }
  }
  return names;
}

TEST(TriagePage, NamesMovesThatThereAre) {
  const std::vector<std::string> names = moves_of_the_triage_page();
  EXPECT_GE(names.size(), 2u);
  for (const std::string& name : names) EXPECT_EQ(known_mutator(name), name);
}

}  // namespace
}  // namespace nearmiss
