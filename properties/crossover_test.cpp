/// The changes of cases for fuzzers: they keep cases valid and exact, depend on the seed alone, and reach touches.
#include "corpus/search/crossover.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>
#include <vector>

#include "corpus/generator/generator.hpp"
#include "corpus/storage/codec.hpp"
#include "corpus/storage/store.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

bool have_same_bits(const Case& a, const Case& b) { return case_to_bytes(a) == case_to_bytes(b); }

/// Expects a valid case, exact in its scalar, that survives both codecs bit for bit.
void expect_sound(const Case& c) {
  const auto invalid = c.query->broken(c.values);
  EXPECT_FALSE(invalid) << invalid->text();
  for (const double x : c.values) EXPECT_TRUE(representable(x, c.scalar)) << x;
  const auto from_bytes = case_from_bytes(*c.query, case_to_bytes(c));
  ASSERT_TRUE(from_bytes);
  EXPECT_TRUE(have_same_bits(*from_bytes, c));
  EXPECT_TRUE(have_same_bits(case_from_json(case_to_json(c), "crossover"), c));
}

class Crossover : public testing::TestWithParam<NamedQuery> {};

TEST_P(Crossover, CrossesIntoSoundCasesByTheSeedAlone) {
  const Query& query = *GetParam().query;
  for (const Scalar scalar : scalars) {
    int changed = 0;
    constexpr int cases = 500;
    for (std::uint64_t i = 0; i < cases; ++i) {
      const Case before = generate(query, scalar, 1, i), other = generate(query, scalars[i % 2], 2, i);
      Case once = before, again = before;
      const bool crossed = cross(once, other, i);
      ASSERT_EQ(cross(again, other, i), crossed);
      ASSERT_TRUE(have_same_bits(once, again));
      ASSERT_EQ(once.values == before.values, !crossed);
      expect_sound(once);
      changed += crossed;
    }
    EXPECT_GE(changed, cases * 99 / 100) << name_of(scalar);
  }
}

double rounded(Scalar scalar, double x) { return scalar == Scalar::float32 ? double(float(x)) : x; }

TEST_P(Crossover, TakesNumbersPartsAndWholeOperandsOfTheOtherCase) {
  const Query& query = *GetParam().query;
  std::map<std::size_t, int> sizes;
  for (std::uint64_t i = 0; i < 500; ++i) {
    const Case before = generate(query, Scalar::float32, 1, i), other = generate(query, Scalar::float64, 2, i);
    Case c = before;
    if (!cross(c, other, i)) continue;
    std::size_t taken = 0;
    for (std::size_t k = 0; k < c.values.size(); ++k) {
      if (c.values[k] == before.values[k]) continue;
      ++taken;
      bool of_other = false;
      for (std::size_t from = 0; from < c.values.size(); ++from) {
        of_other = of_other || (query.inputs[from].role == query.inputs[k].role &&
                                c.values[k] == rounded(Scalar::float32, other.values[from]));
      }
      EXPECT_TRUE(of_other) << query.inputs[k].name << " = " << c.values[k];
    }
    ++sizes[taken];
  }
  EXPECT_GE(sizes[1], 100);
  EXPECT_GE(sizes[3], 20);
  EXPECT_GE(sizes.size(), query.inputs.size() > 6 ? 3u : 2u);
}

/// The number's neighbours in the scalar, within that many ulps, and itself.
std::vector<double> neighbours(Scalar scalar, double x, int ulps) {
  std::vector<double> all{x};
  for (const double end : {HUGE_VAL, -HUGE_VAL}) {
    double at = x;
    for (int i = 0; i < ulps; ++i) {
      at = scalar == Scalar::float32 ? double(std::nextafter(float(at), float(end))) : std::nextafter(at, end);
      all.push_back(at);
    }
  }
  return all;
}

/// Whether the exact decision changes within 4 ulps of input `number`.
bool flips_nearby(Case c, std::size_t number) {
  constexpr int ulps = 4;
  const bool decision = exact_decision(c);
  for (const double x : neighbours(c.scalar, c.values[number], ulps)) {
    c.values[number] = x;
    if (std::isfinite(x) && !c.query->broken(c.values) && exact_decision(c) != decision) return true;
  }
  return false;
}

bool any_flips_nearby(const Case& c, const Case& before) {
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const Role role = c.role(i);
    const bool candidate = c.values == before.values || c.values[i] != before.values[i];
    if (candidate && role != Role::flag && role != Role::index && flips_nearby(c, i)) return true;
  }
  return false;
}

TEST_P(Crossover, SnapsToWhereTheDecisionFlips) {
  const Query& query = *GetParam().query;
  for (const Scalar scalar : scalars) {
    int snapped = 0, yes = 0;
    constexpr int cases = 100;
    for (std::uint64_t i = 0; i < cases; ++i) {
      const Case before = generate(query, scalar, 1, i);
      Case once = before, again = before;
      const bool found = snap_to_touching(once, i);
      ASSERT_EQ(snap_to_touching(again, i), found);
      ASSERT_TRUE(have_same_bits(once, again));
      if (!found) {
        ASSERT_TRUE(have_same_bits(once, before)) << "case " << i;
        continue;
      }
      expect_sound(once);
      EXPECT_TRUE(any_flips_nearby(once, before)) << "case " << i << ": " << case_to_json(once);
      ++snapped, yes += exact_decision(once);
    }
    if (!decides(query.kind)) {
      EXPECT_EQ(snapped, 0);
      continue;
    }
    EXPECT_GE(snapped, cases * 20 / 100) << name_of(scalar);
    EXPECT_GE(yes, snapped * 20 / 100) << name_of(scalar);
    EXPECT_LE(yes, snapped * 80 / 100) << name_of(scalar);
  }
}

TEST_P(Crossover, TakesNumbersOfStoredCasesByTheSeedAlone) {
  const Query& query = *GetParam().query;
  std::map<Role, std::set<double>> stored;
  for (const StoredCase& s : stored_cases(query)) {
    for (std::size_t i = 0; i < query.inputs.size(); ++i) stored[query.inputs[i].role].insert(s.question.values[i]);
  }
  for (const Scalar scalar : scalars) {
    for (std::uint64_t i = 0; i < 500; ++i) {
      const Case before = generate(query, scalar, 1, i);
      Case once = before, again = before;
      ASSERT_TRUE(take_number_of_stored_case(once, i));
      ASSERT_TRUE(take_number_of_stored_case(again, i));
      ASSERT_TRUE(have_same_bits(once, again));
      expect_sound(once);
      std::size_t changed = 0;
      for (std::size_t k = 0; k < once.values.size(); ++k) {
        if (once.values[k] == before.values[k]) continue;
        ++changed;
        const std::set<double>& numbers = stored[query.inputs[k].role];
        EXPECT_TRUE(
            std::any_of(numbers.begin(), numbers.end(), [&](double x) { return rounded(scalar, x) == once.values[k]; }))
            << query.inputs[k].name << " = " << once.values[k];
      }
      EXPECT_EQ(changed, 1u);
    }
  }
}

TEST_P(Crossover, GivesTheSameCasesInEveryThread) {
  const Query& query = *GetParam().query;
  const auto changed = [&] {
    std::vector<std::vector<double>> all;
    for (std::uint64_t i = 0; i < 50; ++i) {
      Case c = generate(query, Scalar::float64, 1, i);
      take_number_of_stored_case(c, i);
      cross(c, generate(query, Scalar::float64, 2, i), i);
      all.push_back(c.values);
    }
    return all;
  };
  std::vector<std::vector<std::vector<double>>> results(4);
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&] { result = changed(); });
  for (std::thread& t : threads) t.join();
  for (const auto& result : results) EXPECT_EQ(result, results.front());
}

INSTANTIATE_FOR_EVERY_QUERY(Every, Crossover, testing::ValuesIn(every_query()), testing::PrintToStringParamName());

TEST(CrossoverOfAnyQuery, TakesNothingWithoutStoredCases) {
  Query unknown = *find_query("sphere_sphere_overlap");
  unknown.name = "no_such_query";
  Case c = generate(*find_query("sphere_sphere_overlap"), Scalar::float64, 1, 0);
  c.query = &unknown;
  const std::vector<double> before = c.values;
  for (std::uint64_t seed = 0; seed < 20; ++seed) EXPECT_FALSE(take_number_of_stored_case(c, seed));
  EXPECT_EQ(c.values, before);
}

TEST(CrossoverOfAnyQuery, TakesNothingOfAnotherQuery) {
  Case c = generate(*find_query("sphere_sphere_overlap"), Scalar::float64, 1, 0);
  const std::vector<double> before = c.values;
  const Case other = generate(*find_query("sphere_sphere_penetration"), Scalar::float64, 1, 1);
  for (std::uint64_t seed = 0; seed < 20; ++seed) EXPECT_FALSE(cross(c, other, seed));
  EXPECT_EQ(c.values, before);
}

/// The sum of the radii decides: the snapped radius is the distance of the centers less the other radius.
TEST(CrossoverOfAnyQuery, SnapsARadiusToTheGap) {
  const Case before{find_query("sphere_sphere_overlap"), Scalar::float64, {0, 0, 0, 1, 8, 0, 0, 2}, "test", 0, 0, {}};
  bool of_first = false;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Case c = before;
    snap_to_touching(c, seed);
    if (c.values[3] == before.values[3]) continue;
    of_first = true;
    const std::vector<double> near = neighbours(Scalar::float64, 6, 4);
    EXPECT_NE(std::find(near.begin(), near.end(), c.values[3]), near.end()) << c.values[3];
  }
  EXPECT_TRUE(of_first);
}

}  // namespace
}  // namespace nearmiss
