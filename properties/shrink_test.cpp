/// The shrinker finds simple cases and keeps the required property.
#include "corpus/search/shrink.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "corpus/generator/generator.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

TEST(Shrink, FindsZerosWhereNothingIsAsked) {
  const Query& query = *find_query("closest_point_segment");
  for (std::uint64_t i = 0; i < 20; ++i) {
    const Case c = shrink(generate(query, Scalar::float64, 1, i), [](const Case&) { return true; });
    EXPECT_EQ(c.values, std::vector<double>(query.inputs.size(), 0.0));
  }
}

TEST(Shrink, FindsTheSimplestNumberOnTheRightSide) {
  const Query& query = *find_query("moving_point_sphere");
  const auto far = [](const Case& c) { return c.values[0] > 100; };
  Case c = generate(query, Scalar::float32, 1, 0);
  c.values[0] = 12345.678f;
  const Case small = shrink(c, far);
  EXPECT_EQ(small.values[0], 128);
}

TEST(Shrink, ReachesADistantExponentInFewQuestions) {
  const Query& query = *find_query("closest_point_segment");
  for (const double border : {0x1p700, 0x1p-700}) {
    Case c = generate(query, Scalar::float64, 1, 0);
    for (double& x : c.values) x = 0;
    c.values[0] = border > 1 ? 0x1.23p1000 : 0x1.23p-1000;
    c.values[1] = 3;  // stays, so that no common scale helps
    int questions = 0;
    const Case small = shrink(c, [&](const Case& simpler) {
      ++questions;
      const double x = simpler.values[0];
      return simpler.values[1] == 3 && (border > 1 ? x >= border : x > 0 && x <= border);
    });
    EXPECT_EQ(small.values[0], border);
    EXPECT_LT(questions, 400);
  }
}

TEST(Shrink, CopiesANumberWhereNoSimplerOneIsLeft) {
  const Query& query = *find_query("closest_point_segment");
  const auto twins = [](const Case& c) { return c.values[0] == 0.75 && (c.values[1] == 77.7 || c.values[1] == 0.75); };
  Case c = generate(query, Scalar::float64, 1, 0);
  c.values[0] = 0.75, c.values[1] = 77.7;
  EXPECT_EQ(shrink(c, twins).values[1], 0.75);
}

class Shrinking : public testing::TestWithParam<NamedQuery> {};

TEST_P(Shrinking, KeepsTheTruthAndStaysValidAndExact) {
  const Query& query = *GetParam().query;
  int looked_at = 0;
  for (Scalar scalar : scalars) {
    for (std::uint64_t i = 0; i < 10; ++i) {
      const Case c = generate(query, scalar, 1, i);
      const bool truth = truth_is_yes(c);
      int questions = 0;
      const Case small = shrink(
          c,
          [&](const Case& smaller) {
            ++questions;
            EXPECT_FALSE(query.broken(smaller.values));
            for (double x : smaller.values) EXPECT_TRUE(representable(x, scalar));
            return truth_is_yes(smaller) == truth;
          },
          500);
      EXPECT_EQ(truth_is_yes(small), truth);
      EXPECT_LE(questions, 500);
      const std::set<double> before(c.values.begin(), c.values.end()), after(small.values.begin(), small.values.end());
      EXPECT_LE(after.size(), before.size());
      // A hit on a small target needs all numbers of a point and its velocity to change at once: there 8 numbers
      // remain. If a change by 1/64 flips the decision, nearly every change of a single number flips it.
      const bool thin = query.name.starts_with("moving_point_");
      const double margin = truth_of(c).margin_at_least * unit_roundoff(scalar);
      if (margin < 1.0 / 64) continue;
      EXPECT_LE(after.size(), thin ? 8u : 6u)
          << query.name << " case " << i << ", " << margin << " from the other decision";
      ++looked_at;
    }
  }
  EXPECT_GE(looked_at, 1);
}

INSTANTIATE_FOR_EVERY_QUERY(Every, Shrinking, testing::ValuesIn(every_query()), testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
