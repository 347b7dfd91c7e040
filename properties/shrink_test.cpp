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

Case with_values(const std::vector<double>& values) {
  Case c = generate(*find_query("sphere_sphere_overlap"), Scalar::float64, 1, 0);
  c.values = values;
  return c;
}

/// Of the inputs of sphere_sphere_overlap.
TEST(Shrink, HasAnOrderWithFewerElementsFirst) {
  const std::vector<std::vector<double>> from_the_simplest = {
      {0, 0, 0, 0, 0, 0, 0, 0},          // no number but 0
      {-0.0, 0, 0, 0, 0, 0, 0, 0},       // one sign more
      {0, 0, 0, 1, 0, 0, 0, 0},          // one number that is not 0
      {0, 0, 0, 4, 0, 0, 0, 0},          // one bit, an exponent
      {0, 0, 0, 3, 0, 0, 0, 0},          // two bits
      {0, 0, 0, 1e300 / 3, 0, 0, 0, 0},  // the longest number is simpler than two numbers
      {1, 0, 0, 1, 0, 0, 0, 0},          // two numbers
      {-1, 0, 0, 1, 0, 0, 0, 0},         // and a sign
      {4, 0, 0, 4, 0, 0, 0, 0},          // two numbers of one magnitude
      {2, 0, 0, 8, 0, 0, 0, 0},          // as long, of two magnitudes
      {1, 1, 1, 0, 0, 0, 0, 0},          // three numbers
  };
  for (std::size_t i = 1; i < from_the_simplest.size(); ++i) {
    EXPECT_LT(simplicity_of(with_values(from_the_simplest[i - 1])), simplicity_of(with_values(from_the_simplest[i])))
        << "row " << i;
  }
}

TEST(Shrink, PrefersALongNumberToTwoShortOnes) {
  const auto keeps = [](const Case& c) { return c.values[4] - c.values[0] == 1 - 0x1p-30; };
  const Case small = shrink(with_values({0x1p-30, 0, 0, 0, 1, 0, 0, 0}), keeps);
  EXPECT_EQ(simplicity_of(small).not_zero, 1u);
}

TEST(Shrink, GivesAMemberItsSimplestValueInOneStep) {
  const Query& query = *find_query("box_box_overlap");
  const std::size_t rotation = *query.operands[0].rotation;
  const auto upright_or_as_it_was = [&](const Case& c) {
    const double* q = &c.values[rotation];
    const bool upright = q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 1;
    return upright || (q[0] == 0.1 && q[1] == 0.2 && q[2] == 0.3 && q[3] == 0.4);
  };
  Case c = generate(query, Scalar::float64, 1, 0);
  for (std::size_t k = 0; k < 4; ++k) c.values[rotation + k] = 0.1 * double(k + 1);
  c.values[rotation + 2] = 0.3;
  ASSERT_TRUE(upright_or_as_it_was(c));
  EXPECT_EQ(shrink(c, upright_or_as_it_was).values[rotation + 3], 1);
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

/// The finding is the decision, and one number of half its magnitude or more.
TEST_P(Shrinking, LeavesNoSimplerCaseOneStepAway) {
  const Query& query = *GetParam().query;
  for (std::uint64_t i = 0; i < 3; ++i) {
    const Case c = generate(query, scalars[i % 2], 2, i);
    const bool truth = truth_is_yes(c);
    int questions = 0;
    const auto keeps = [&](const Case& simpler) {
      ++questions;
      return truth_is_yes(simpler) == truth && std::abs(simpler.values[i]) >= std::abs(c.values[i]) / 2;
    };
    const Case small = shrink(c, keeps);
    ASSERT_LT(questions, 20000);
    EXPECT_LE(simplicity_of(small), simplicity_of(c));
    for (const Case& simpler : simpler_by_one_step(small)) {
      EXPECT_LT(simplicity_of(simpler), simplicity_of(small));
      EXPECT_FALSE(keeps(simpler)) << query.name << " case " << i;
    }
    for (std::size_t k = 0; k < small.values.size(); ++k) {  // without the list of steps
      Case simpler = small;
      simpler.values[k] = 0;
      const bool is_simpler = small.values[k] != 0 && !query.broken(simpler.values);
      EXPECT_FALSE(is_simpler && keeps(simpler)) << query.name << " case " << i << ", number " << k;
    }
  }
}

INSTANTIATE_FOR_EVERY_QUERY(Every, Shrinking, testing::ValuesIn(every_query()), testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
