/// Exact touches are distinguished from near ones and counted; two conventions in one library are reported.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "oracles/touch.hpp"
#include "reports/engine/touch_counts.hpp"

namespace nearmiss {
namespace {

struct Contact {
  const char* name;
  const char* query;
  std::vector<double> inputs;
  bool exact_touch;
};
void PrintTo(const Contact& c, std::ostream* out) { *out << c.name; }

const Contact contacts[] = {
    {"balls_that_touch", "sphere_sphere_overlap", {0, 0, 0, 1, 2, 2, 1, 2}, true},
    {"balls_that_overlap_by_an_ulp", "sphere_sphere_overlap", {0, 0, 0, 0x1.0000000000001p0, 2, 2, 1, 2}, false},
    {"balls_that_overlap", "sphere_sphere_overlap", {0, 0, 0, 2, 2, 2, 1, 2}, false},
    {"a_ball_at_the_face_of_a_box", "sphere_box_overlap", {2, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1}, true},
    {"a_ball_at_the_vertex_of_a_box", "sphere_box_overlap", {3, 3, 2, 3, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1}, true},
    {"a_ball_in_a_box", "sphere_box_overlap", {0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1}, false},
    {"a_ball_at_the_edge_of_a_triangle", "sphere_triangle_overlap", {1, -3, 0, 3, 0, 0, 0, 4, 0, 0, 0, 4, 0}, true},
    {"boxes_face_to_face", "box_box_overlap", {0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 2, 0.5, 0, 1, 1, 1, 0, 0, 0, 1, -1}, true},
    {"a_ball_that_grazes_a_box", "moving_sphere_box", {-9, 2, 0, 1, 1, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1}, true},
    {"a_ball_that_starts_at_a_box", "moving_sphere_box", {-2, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1}, true},
    {"a_ball_that_hits_a_box", "moving_sphere_box", {-9, 1, 0, 1, 1, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1}, false},
    {"a_ray_along_a_face", "ray_aabox", {0, 1, 0, 1, 0, 0, 2, -1, -1, 3, 1, 1}, true},
};

class Contacts : public testing::TestWithParam<Contact> {};

TEST_P(Contacts, AreExactTouchesOrNot) {
  const Contact& c = GetParam();
  const Case question{find_query(c.query), Scalar::float64, c.inputs, "test", 0, 0, {}};
  ASSERT_EQ(question.values.size(), question.fields().size());
  ASSERT_TRUE(truth_of(question).yes);
  EXPECT_EQ(touches_exactly(question), c.exact_touch);
}

INSTANTIATE_TEST_SUITE_P(Touch, Contacts, testing::ValuesIn(contacts),
                         [](const auto& test) { return std::string(test.param.name); });

/// Counts `n` answers to an exact touch of two bodies.
void touch(TouchCounts& touches, const Subject& s, const Contact& c, bool says, std::uint64_t n) {
  const Case question{find_query(c.query), Scalar::float64, c.inputs, "test", 0, 0, {"small-lattice", "touch-by-size"}};
  Answer a;
  a.yes = says;
  a.given = 0;
  const Finding f = judge(question, a, {}, Detail::verdict);
  std::optional<bool> known;
  for (std::uint64_t i = 0; i < n; ++i) touches.count(question, s, a, f, known);
}

TEST(Touches, AreCountedByFeature) {
  const Subject s{.name = "s", .version = "1", .scalar = Scalar::float64, .offerings = {}};
  TouchCounts touches;
  touch(touches, s, contacts[0], true, 3);
  touch(touches, s, contacts[0], false, 5);
  touch(touches, s, contacts[1], true, 7);  // no touch
  EXPECT_EQ(touches.to_json().dump(),
            R"([{"query":"sphere_sphere_overlap","subject":"s","feature":"touch-by-size","touches":8,"yes":3}])");
  EXPECT_EQ(touches.text(),
            "Exact touches, which count as contact:\n"
            "  s sphere_sphere_overlap: of 8 exact touches, yes in 3 (touch-by-size 3 of 8)\n");
}

TEST(Touches, ClosedHereAndStrictThereIsInconsistent) {
  const Subject closed{.name = "closed", .version = "1", .scalar = Scalar::float64, .offerings = {}},
      both{.name = "both", .version = "1", .scalar = Scalar::float64, .offerings = {}};
  TouchCounts touches;
  touch(touches, closed, contacts[0], true, TouchCounts::enough);
  touch(touches, closed, contacts[3], true, TouchCounts::enough);
  touch(touches, both, contacts[0], true, TouchCounts::enough);
  touch(touches, both, contacts[3], false, TouchCounts::enough - 1);
  EXPECT_TRUE(touches.inconsistent().empty()) << "too few to tell";
  touch(touches, both, contacts[3], false, 1);
  ASSERT_EQ(touches.inconsistent().size(), 1u);
  EXPECT_EQ(touches.inconsistent()[0].subject, &both);
  EXPECT_EQ(touches.inconsistent()[0].closed, std::vector<std::string>{"sphere_sphere_overlap"});
  EXPECT_EQ(touches.inconsistent()[0].strict, std::vector<std::string>{"sphere_box_overlap"});
}

}  // namespace
}  // namespace nearmiss
