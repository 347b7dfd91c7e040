/// Which cases meet a precondition, and that the generator's cases can be fitted to each precondition.
#include "oracles/requirements.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "corpus/generator/fit.hpp"
#include "corpus/generator/generator.hpp"
#include "oracles/judge.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

Case with(std::string_view query, std::vector<double> values, Scalar scalar = Scalar::float64) {
  return {find_query(query), scalar, std::move(values), "test", 0, 0, {}};
}

bool outside(std::string_view query, std::vector<double> values) {
  return meets(with(query, std::move(values)), Precondition::starts_outside);
}

/// A touching start is not outside; a start one step further is outside.
TEST(Preconditions, StartsAreDecidedExactly) {
  const double next = std::nextafter(3.0, 4.0);
  EXPECT_FALSE(outside("moving_sphere_sphere", {3, 0, 0, 1, -1, 0, 0, 0, 0, 0, 2}));
  EXPECT_TRUE(outside("moving_sphere_sphere", {next, 0, 0, 1, -1, 0, 0, 0, 0, 0, 2}));
  EXPECT_FALSE(outside("moving_sphere_capsule", {3, 0, 0, 1, -1, 0, 0, 0, -1, 0, 0, 1, 0, 2}));
  EXPECT_TRUE(outside("moving_sphere_capsule", {next, 0, 0, 1, -1, 0, 0, 0, -1, 0, 0, 1, 0, 2}));
  EXPECT_FALSE(outside("moving_point_capsule", {1, 0, 0, -1, 0, 0, 0, -1, 0, 0, 1, 0, 2})) << "strictly inside";
  EXPECT_FALSE(outside("moving_point_capsule", {0, 0.5, 0, 1, 0, 0, 0, -1, 0, 0, 1, 0, 0})) << "on a bare segment";
  EXPECT_TRUE(outside("moving_point_capsule", {0, 1.5, 0, 1, 0, 0, 0, -1, 0, 0, 1, 0, 0}));
  EXPECT_FALSE(outside("moving_sphere_box", {3, 0, 0, 2, 1, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1}));
  EXPECT_TRUE(outside("moving_sphere_box", {next, 0, 0, 2, 1, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1}));
  EXPECT_FALSE(outside("moving_point_plane", {0, 0, -1, 0, 0, 1, 0, 0, 1, 0})) << "behind";
  EXPECT_FALSE(outside("moving_point_plane", {0, 0, 0, 0, 0, 1, 0, 0, 1, 0}));
  EXPECT_TRUE(outside("moving_point_plane", {0, 0, 0x1p-1074, 0, 0, 1, 0, 0, 1, 0}));
  EXPECT_FALSE(outside("ray_aabox", {1, 0.5, 0.5, 1, 0, 0, 0, 0, 0, 1, 1, 1}));
  EXPECT_TRUE(outside("ray_aabox", {1.5, 0.5, 0.5, 1, 0, 0, 0, 0, 0, 1, 1, 1}));
}

/// Both triangles of a rectangle count, wherever its four corners are.
TEST(Preconditions, AStartOutsideOfARectangleIsOutsideOfBothTriangles) {
  const auto at = [](double x, double y, double z) {
    return outside("moving_point_rectangle", {x, y, z, 0, 0, -1, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  };
  EXPECT_FALSE(at(0.75, 0.25, 0));
  EXPECT_FALSE(at(0.25, 0.75, 0));
  EXPECT_TRUE(at(0.25, 0.75, 1));
  EXPECT_TRUE(at(1.25, 0.75, 0));
}

TEST(Preconditions, UnitLengthIsHeldToFourEpsilonOfTheCasesScalar) {
  for (const Scalar scalar : scalars) {
    const double epsilon = unit_roundoff(scalar);
    const auto unit = [&](double z) {
      return meets(with("moving_point_plane", {0, 0, 0, 0, 0, 1, 0, 0, z, 0}, scalar), Precondition::unit_normal);
    };
    EXPECT_TRUE(unit(1));
    EXPECT_TRUE(unit(1 + 2 * epsilon));
    EXPECT_TRUE(unit(1 - 3 * epsilon));
    EXPECT_FALSE(unit(1 + 6 * epsilon));
    EXPECT_FALSE(unit(1 - 5 * epsilon));
    EXPECT_FALSE(unit(2));
  }
  EXPECT_TRUE(meets(with("sphere_sphere_overlap", {0, 0, 0, 1, 0, 0, 0, 1}), Precondition::unit_normal))
      << "there is none";
}

bool rectangle(std::array<double, 12> corners) {
  std::vector<double> values(corners.begin(), corners.end());
  values.insert(values.end(), {0, 0, 0});
  return meets(with("closest_point_rectangle", values), Precondition::true_rectangle);
}

TEST(Preconditions, ATrueRectangleHasRightAnglesParallelSidesAndAnArea) {
  const double u = 0x1p-52;
  EXPECT_TRUE(rectangle({0, 0, 0, 3, 4, 0, -1, 7, 0, -4, 3, 0}));
  EXPECT_TRUE(rectangle({0, 0, 0, 1, 0, 0, 1 + u, 1, 0, 0, 1, 0}));
  EXPECT_FALSE(rectangle({0, 0, 0, 1, 0, 0, 1 + 8 * u, 1, 0, 0, 1, 0})) << "open";
  EXPECT_FALSE(rectangle({0, 0, 0, 1, 0, 0, 1 + 8 * u, 1, 0, 8 * u, 1, 0})) << "askew";
  EXPECT_FALSE(rectangle({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 1})) << "folded";
  EXPECT_FALSE(rectangle({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0})) << "in another order";
  EXPECT_FALSE(rectangle({0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0})) << "a segment";
  EXPECT_FALSE(rectangle({5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5})) << "a point";
}

TEST(Preconditions, NoSizeAndNoAreaIsZero) {
  const auto sized = [](std::string_view query, std::vector<double> values) {
    return meets(with(query, std::move(values)), Precondition::no_zero_sizes);
  };
  EXPECT_TRUE(sized("sphere_sphere_overlap", {0, 0, 0, 0x1p-1074, 0, 0, 0, 1}));
  EXPECT_FALSE(sized("sphere_sphere_overlap", {0, 0, 0, 0, 0, 0, 0, 1}));
  EXPECT_FALSE(sized("ray_aabox", {0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 1}));
  EXPECT_FALSE(sized("closest_point_segment", {1, 2, 3, 1, 2, 3, 0, 0, 0}));
  EXPECT_TRUE(sized("closest_point_segment", {1, 2, 3, 1, 2, std::nextafter(3.0, 4.0), 0, 0, 0}));
  EXPECT_FALSE(sized("sphere_triangle_overlap", {0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 3, 3, 3}));
  EXPECT_TRUE(sized("sphere_triangle_overlap", {0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 3, 3, 4}));
}

struct Served {
  const Query* query;
  Precondition precondition;
  friend std::ostream& operator<<(std::ostream& out, const Served& s) {
    std::string name(name_of(s.precondition));
    std::replace(name.begin(), name.end(), ' ', '_');
    return out << s.query->name << "__" << name;
  }
};

std::vector<Served> all_served() {
  std::vector<Served> all;
  for (const Query& q : catalogue()) {
    for (const Precondition p : all_preconditions) {
      if (concerns(p, q)) all.push_back({&q, p});
    }
  }
  return all;
}

class FittedCases : public testing::TestWithParam<Served> {};

void expect_served(const Query& query, Preconditions required, std::string_view what) {
  constexpr int cases = 1000;
  for (const Scalar scalar : scalars) {
    int inside = 0, yes = 0;
    Case c;
    for (std::uint64_t i = 0; i < cases; ++i) {
      generate_inside(c, query, scalar, 1, i, required);
      ASSERT_FALSE(query.broken(c.values));
      for (const double x : c.values) ASSERT_TRUE(representable(x, scalar) && std::isfinite(x));
      const bool is_inside = unmet_by(c, required).empty();
      inside += is_inside;
      yes += is_inside && decides(query.kind) && exact_decision(c);
    }
    EXPECT_GE(inside, cases * 95 / 100) << name_of(scalar) << ", " << what;
    if (!decides(query.kind)) continue;
    const int least = query.name == "box_box_conservative" ? 6 : 10;
    EXPECT_GE(yes, inside * least / 100) << name_of(scalar) << ", " << what;
    EXPECT_LE(yes, inside * (100 - least) / 100) << name_of(scalar) << ", " << what;
  }
}

TEST_P(FittedCases, AreInsideAndMixYesAndNo) {
  expect_served(*GetParam().query, {GetParam().precondition}, name_of(GetParam().precondition));
}

INSTANTIATE_FOR_EVERY_QUERY(Every, FittedCases, testing::ValuesIn(all_served()), testing::PrintToStringParamName());

class FittedToAll : public testing::TestWithParam<NamedQuery> {};

TEST_P(FittedToAll, AreInsideAndMixYesAndNo) {
  Preconditions all;
  for (const Precondition p : all_preconditions) all.add(p);
  expect_served(*GetParam().query, all, "all of them");
}

/// Without a precondition the stream is the generator's, and a case that meets the preconditions stays unchanged.
TEST_P(FittedToAll, ChangeOnlyWhatIsOutside) {
  const Query& query = *GetParam().query;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Case plain = generate(query, Scalar::float64, 1, i);
    Case c;
    generate_inside(c, query, Scalar::float64, 1, i, {});
    ASSERT_EQ(c.values, plain.values);
    for (const Precondition p : all_preconditions) {
      generate_inside(c, query, Scalar::float64, 1, i, {p});
      if (meets(plain, p)) {
        ASSERT_EQ(c.values, plain.values);
      }
      ASSERT_EQ(c.values != plain.values, c.origin != plain.origin);
    }
  }
}

INSTANTIATE_FOR_EVERY_QUERY(Every, FittedToAll, testing::ValuesIn(every_query()), testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
