/// checked() returns valid shapes unchanged and reports a broken rule in one line.
#include <collide/checked.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "corpus/generator/generator.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

using namespace collide;  // this file tests shapes alone

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

constexpr Box<double> crate{{1, 2, 3}, {1, 0, 2}, {0, 0, 0, 2}};

template <class S>
std::string complaint(const S& s) {
  try {
    checked(s);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}
template <class S>
std::string complaint(const S& s, std::string_view name) {
  try {
    checked(s, name);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TEST(Checked, GivesBackAShapeThatKeepsItsRules) {
  constexpr Sphere<float> point = checked(Sphere<float>{{1, 2, 3}, 0});  // at compile time
  static_assert(point.center.z == 3 && point.radius == 0);
  static_assert(!broken_rule(crate));
  static_assert(noexcept(broken_rule(crate)));
  EXPECT_EQ(checked(crate).half, crate.half);
  EXPECT_EQ(complaint(Segment<double>{}), "");
  EXPECT_EQ(complaint(Triangle<double>{}), "");
  EXPECT_EQ(complaint(Rectangle<double>{}), "");
  EXPECT_EQ(complaint(Capsule<double>{}), "");
  EXPECT_EQ(complaint(AABox<double>{}), "");
  EXPECT_EQ(complaint(Line<double>{}), "");
  EXPECT_EQ(complaint(Ray<double>{}), "");
  EXPECT_EQ(complaint(Plane<double>{}), "");
  EXPECT_EQ(complaint(Vec3<double>{}), "");
  EXPECT_EQ(complaint(Sphere<double>{{}, -0.0}), "");
  EXPECT_EQ(complaint(Vec3<float>{std::numeric_limits<float>::max(), -std::numeric_limits<float>::max(), 1e-45f}), "");
}

TEST(Checked, NamesFieldValueAndRule) {
  EXPECT_EQ(complaint(Sphere<double>{{}, -1}), "sphere.radius is -1: it must be not negative");
  EXPECT_EQ(complaint(Capsule<float>{{}, {}, -0.5f}), "capsule.radius is -0.5: it must be not negative");
  EXPECT_EQ(complaint(Box<double>{{}, {1, -1e-300, 1}}), "box.half.y is -1e-300: it must be not negative");
  EXPECT_EQ(complaint(Box<double>{{}, {}, {0, 0, 0, 0}}),
            "box.orientation.w is 0: it must be not all of x, y, z, w zero");
  EXPECT_EQ(complaint(AABox<double>{{0, 0, 2}, {1, 1, 1}}), "aabox.max.z is 1: it must be not below min.z");
  EXPECT_EQ(complaint(Plane<double>{{0, 0, 0}, 1}), "plane.normal is 0: it must be not all of x, y, z zero");
  EXPECT_EQ(complaint(Line<double>{{}, {0, -0.0, 0}}), "line.direction is 0: it must be not all of x, y, z zero");
  EXPECT_EQ(complaint(Ray<double>{{}, {}}), "ray.direction is 0: it must be not all of x, y, z zero");
  EXPECT_EQ(complaint(Quaternion<double>{0, 0, 0, 0}), "quaternion.w is 0: it must be not all of x, y, z, w zero");
}

TEST(Checked, RefusesWhatIsNotFinite) {
  EXPECT_EQ(complaint(Sphere<double>{{0, nan, 0}, 1}), "sphere.center.y is nan: it must be finite");
  EXPECT_EQ(complaint(Sphere<double>{{}, infinity}), "sphere.radius is inf: it must be finite");
  EXPECT_EQ(complaint(AABox<double>{{nan, 0, 0}, {}}), "aabox.min.x is nan: it must be finite");
  EXPECT_EQ(complaint(Triangle<float>{{}, {}, {0, 0, -HUGE_VALF}}), "triangle.v2.z is -inf: it must be finite");
  EXPECT_EQ(complaint(Vec3<double>{0, 0, infinity}), "vector.z is inf: it must be finite");
}

TEST(Checked, TakesTheCallersName) {
  EXPECT_EQ(complaint(Sphere<double>{{}, -1}, "ball"), "ball.radius is -1: it must be not negative");
  EXPECT_EQ(complaint(Sphere<double>{{}, -1}, ""), "radius is -1: it must be not negative");
}

TEST(Checked, KnowsAVectorThatMustNotBeZero) {
  EXPECT_EQ(checked_direction(Vec3<double>{0, 1, 0}).y, 1);
  EXPECT_THROW(checked_direction(Vec3<double>{0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(checked_direction(Vec3<double>{0, nan, 0}), std::invalid_argument);
}

/// The same rules for every query's inputs: spoils one number of a valid case.
TEST(Checked, RulesHoldForTheInputsOfEveryQuery) {
  for (const Query& query : catalogue()) {
    for (std::size_t i = 0; i < query.inputs.size(); ++i) {
      const Field& field = query.inputs[i];
      Case c = generate(query, Scalar::float64, 11, i);
      c.values[i] = nan;
      auto invalid = query.broken(c.values);
      ASSERT_TRUE(invalid) << query.name << ": " << field.name;
      EXPECT_EQ(invalid->field, field.name) << query.name;
      if (field.role != Role::size) continue;
      c.values[i] = -0.5;
      invalid = query.broken(c.values);
      ASSERT_TRUE(invalid) << query.name << ": " << field.name;
      EXPECT_EQ(invalid->text(), field.name + " is -0.5: it must be not negative") << query.name;
    }
  }
}

}  // namespace
}  // namespace nearmiss
