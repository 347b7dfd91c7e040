/// Answers derived by hand: each right one must agree, each wrong one must be refuted. The numbers are
/// small integers, so that the right answer is exact, and the derivation stands beside it.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "oracles/judge.hpp"

namespace nearmiss {
namespace {

struct Hand {
  std::string name;
  const char* query;
  std::vector<double> inputs;
  bool right;  ///< is the answer below a right one?
  bool yes;
  std::vector<double> answer;  ///< its first numbers
};

/// A promise that nothing but an exact answer, rounded once, keeps.
constexpr collide::Contract strict{.backward = 0, .forward = 1, .exact_decisions = true, .unit = 4};

class ByHand : public testing::TestWithParam<Hand> {};

TEST_P(ByHand, TheJudgeKnows) {
  const Hand& hand = GetParam();
  const Case c{find_query(hand.query), Scalar::float64, hand.inputs, "hand", 0, 0, {}};
  ASSERT_EQ(c.values.size(), c.query->inputs.size());
  ASSERT_FALSE(c.query->broken(c.values));
  Answer a;
  a.yes = hand.yes;
  a.given = (std::uint64_t{1} << hand.answer.size()) - 1;
  std::copy(hand.answer.begin(), hand.answer.end(), a.values.begin());
  const Finding f = judge(c, a, strict, Detail::full);
  EXPECT_EQ(f.verdict, hand.right ? Verdict::agrees : Verdict::violates_contract)
      << name_of(f.disagreement) << ", " << f.forward_ulps << " ulp, " << f.clause;
}

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double r2 = 0.70710678118654752440;  // sqrt(1/2)

// closest_point_segment: v0, v1, point.
const std::vector<double> diagonal{0, 0, 0, 2, 2, 0};
std::vector<double> with(std::vector<double> a, const std::vector<double>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// moving_point_triangle: point, velocity, then this triangle in the plane z = 0, front up.
const std::vector<double> triangle{0, 0, 0, 4, 0, 0, 0, 4, 0};

// moving_sphere_box: center, radius, velocity, then the box |x|, |y|, |z| <= 1.
const std::vector<double> cube{0, 0, 0, 1, 1, 1, 0, 0, 0, 1};
// The same cube turned about z with cosine 3/5 and sine 4/5: q = (0, 0, 1, 2).
const std::vector<double> turned{0, 0, 0, 1, 1, 1, 0, 0, 1, 2};

std::vector<Hand> hands() {
  return {
      // The foot of (2, 0, 0) on the diagonal is its middle (1, 1, 0): ((2,0,0) - (1,1,0)) . (2,2,0) = 0.
      {"foot", "closest_point_segment", with(diagonal, {2, 0, 0}), true, true, {1, 1, 0}},
      {"foot_off", "closest_point_segment", with(diagonal, {2, 0, 0}), false, true, {1, 1, 0.001}},
      {"before_v0", "closest_point_segment", with(diagonal, {-1, -1, 5}), true, true, {0, 0, 0}},
      {"exactly_at_v1", "closest_point_segment", with(diagonal, {3, 1, 7}), true, true, {2, 2, 0}},
      {"a_point", "closest_point_segment", {1, 2, 3, 1, 2, 3, 9, 9, 9}, true, true, {1, 2, 3}},

      // From (1, 1, 2) downward at speed 1: the plane after 2, inside since 1 + 1 < 4.
      {"face", "moving_point_triangle", with({1, 1, 2, 0, 0, -1}, triangle), true, true, {2, 1, 1, 0, 0, 0, 1}},
      {"face_late", "moving_point_triangle", with({1, 1, 2, 0, 0, -1}, triangle), false, true, {2.25, 1, 1, 0, 0, 0, 1}},
      {"face_flipped", "moving_point_triangle", with({1, 1, 2, 0, 0, -1}, triangle), false, true, {2, 1, 1, 0, 0, 0, -1}},
      // (2, 2) lies on the edge x + y = 4: closed.
      {"edge", "moving_point_triangle", with({2, 2, 2, 0, 0, -1}, triangle), true, true, {2, 2, 2, 0, 0, 0, 1}},
      {"vertex", "moving_point_triangle", with({4, 0, 2, 0, 0, -1}, triangle), true, true, {2, 4, 0, 0, 0, 0, 1}},
      {"beside", "moving_point_triangle", with({3, 2, 2, 0, 0, -1}, triangle), true, false, {inf}},
      {"from_behind", "moving_point_triangle", with({1, 1, -2, 0, 0, 1}, triangle), true, false, {inf}},
      {"along", "moving_point_triangle", with({1, 1, 0, 1, 0, 0}, triangle), true, false, {inf}},
      {"starts_on_it", "moving_point_triangle", with({1, 1, 0, 0, 0, -1}, triangle), true, true, {0, 1, 1, 0, 0, 0, 1}},
      {"no_area", "moving_point_triangle", {1, 0, 2, 0, 0, -1, 0, 0, 0, 1, 0, 0, 2, 0, 0}, true, false, {inf}},

      // point, velocity, center, radius, solid. From (-5, 0, 0) at speed 2 to the sphere of radius 3 at 0:
      // x = -3 after 1.
      {"head_on", "moving_point_sphere", {-5, 0, 0, 2, 0, 0, 0, 0, 0, 3, 1}, true, true, {1, -3, 0, 0, -1, 0, 0}},
      // At height 3 the line touches in (0, 3, 0).
      {"tangent", "moving_point_sphere", {-5, 3, 0, 1, 0, 0, 0, 0, 0, 3, 1}, true, true, {5, 0, 3, 0, 0, 1, 0}},
      {"tangent_missed", "moving_point_sphere", {-5, 3, 0, 1, 0, 0, 0, 0, 0, 3, 1}, false, false, {inf}},
      {"starts_inside_solid", "moving_point_sphere", {1, 0, 0, 1, 0, 0, 0, 0, 0, 3, 1}, true, true, {0, 1, 0, 0, 1, 0, 0}},
      {"starts_inside_hollow", "moving_point_sphere", {1, 0, 0, 1, 0, 0, 0, 0, 0, 3, 0}, true, true, {2, 3, 0, 0, 1, 0, 0}},
      // On the surface and leaving: the exit is now. Entering: the chord (-3..3) is left after 6.
      {"hollow_leaving", "moving_point_sphere", {3, 0, 0, 1, 0, 0, 0, 0, 0, 3, 0}, true, true, {0, 3, 0, 0, 1, 0, 0}},
      {"hollow_entering", "moving_point_sphere", {3, 0, 0, -1, 0, 0, 0, 0, 0, 3, 0}, true, true, {6, -3, 0, 0, -1, 0, 0}},
      {"at_the_center_any_normal", "moving_point_sphere", {0, 0, 0, 1, 0, 0, 0, 0, 0, 3, 1}, true, true, {0, 0, 0, 0, 0, 0.6, 0.8}},
      {"at_rest_outside", "moving_point_sphere", {5, 0, 0, 0, 0, 0, 0, 0, 0, 3, 1}, true, false, {inf}},
      {"at_rest_in_hollow", "moving_point_sphere", {1, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0}, true, false, {inf}},

      // Radius 1 from x = 5 at speed 1: centers 2 apart after 3, contact on the face x = 1.
      {"onto_face", "moving_sphere_box", with({5, 0, 0, 1, -1, 0, 0}, cube), true, true, {3, 1, 0, 0, 1, 0, 0}},
      // At y = 2 exactly the sphere grazes the face y = 1 from x = 1 on: first over the edge, distance 1.
      {"graze", "moving_sphere_box", with({5, 2, 0, 1, -1, 0, 0}, cube), true, true, {4, 1, 1, 0, 0, 1, 0}},
      {"graze_at_its_end", "moving_sphere_box", with({5, 2, 0, 1, -1, 0, 0}, cube), false, true, {6, -1, 1, 0, 0, 1, 0}},
      // From the edge (1, 1, *) the center (4, 5) is (3, 4) away: radius 5 touches at the start.
      {"touch_at_edge", "moving_sphere_box", with({4, 5, 0, 5, -1, 0, 0}, cube), true, true, {0, 1, 1, 0, 0.6, 0.8, 0}},
      {"touch_and_leave", "moving_sphere_box", with({4, 5, 0, 5, 1, 0, 0}, cube), true, false, {inf}},
      {"touch_and_slide", "moving_sphere_box", with({4, 5, 0, 5, 0, 0, 1}, cube), true, true, {0, 1, 1, 0, 0.6, 0.8, 0}},
      {"overlap_leaving", "moving_sphere_box", with({1.5, 0, 0, 1, 7, 0, 0}, cube), true, true, {0, 1, 0, 0, 1, 0, 0}},
      // Center inside, nearest face x = 1; at the center of the cube any of six faces is nearest.
      {"center_inside", "moving_sphere_box", with({0.5, 0, 0, 1, 0, 0, 1}, cube), true, true, {0, 1, 0, 0, 1, 0, 0}},
      {"center_in_the_middle", "moving_sphere_box", with({0, 0, 0, 1, 0, 0, 1}, cube), true, true, {0, 0, 0, -1, 0, 0, -1}},
      {"no_such_face", "moving_sphere_box", with({0.5, 0, 0, 1, 0, 0, 1}, cube), false, true, {0, -1, 0, 0, -1, 0, 0}},
      // A point that hits the vertex (1, 1, 1) along the diagonal: any normal of the octant is right.
      {"point_at_vertex", "moving_sphere_box", with({3, 3, 3, 0, -1, -1, -1}, cube), true, true, {2, 1, 1, 1, r2, 0, r2}},
      {"point_at_vertex_inward", "moving_sphere_box", with({3, 3, 3, 0, -1, -1, -1}, cube), false, true, {2, 1, 1, 1, r2, 0, -r2}},
      {"point_inside", "moving_sphere_box", with({0, 0, 0, 0, 1, 0, 0}, cube), true, false, {inf}},
      {"point_on_face_entering", "moving_sphere_box", with({1, 0, 0, 0, -1, 0, 0}, cube), true, true, {0, 1, 0, 0, 1, 0, 0}},
      {"point_on_face_leaving", "moving_sphere_box", with({1, 0, 0, 0, 1, 0, 0}, cube), true, false, {inf}},
      // Along the turned box's first axis (3, 4) / 5 from distance 10 at speed 5: 2 apart after 8/5.
      {"turned_face", "moving_sphere_box", with({6, 8, 0, 1, -3, -4, 0}, turned), true, true, {1.6, 0.6, 0.8, 0, 0.6, 0.8, 0}},

      // Two cubes; they share the vertex (1, 1, 1), then are an ulp apart.
      {"share_a_vertex", "box_box_overlap", with(with(cube, {2, 2, 2, 1, 1, 1, 0, 0, 0, 1}), {-1}), true, true, {}},
      {"an_ulp_apart", "box_box_overlap", with(with(cube, {2 + 0x1p-51, 2, 2, 1, 1, 1, 0, 0, 0, 1}), {-1}), true, false, {}},
      {"hint_changes_nothing", "box_box_overlap", with(with(cube, {2, 2, 2, 1, 1, 1, 0, 0, 0, 1}), {14}), true, true, {}},
      // A turned cube of half extent 5 reaches 5 (3 + 4) / 5 = 7 along x, and the other one 1.
      {"turned_apart", "box_box_overlap", with(with(cube, {12, 0, 0, 5, 5, 5, 0, 0, 1, 2}), {-1}), false, true, {}},
      {"turned_touch", "box_box_overlap", with(with(cube, {8, 0, 0, 5, 5, 5, 0, 0, 1, 2}), {-1}), true, true, {}},

      // center, radius, cube. Outside by 2 with radius 3: depth 1, into the box along -x.
      {"depth_outside", "sphere_box_penetration", with({3, 0, 0, 3}, cube), true, true, {1, -1, 0, 0, 1, 0, 0}},
      {"depth_at_edge", "sphere_box_penetration", with({4, 5, 0, 5}, cube), true, true, {0, -0.6, -0.8, 0, 1, 1, 0}},
      {"depth_apart", "sphere_box_penetration", with({4, 5, 0, 4}, cube), true, false, {-1}},
      // Inside by 1/4 below the face x = 1: depth 1 + 1/4, deepest point 1 further in.
      {"depth_inside", "sphere_box_penetration", with({0.75, 0, 0, 1}, cube), true, true, {1.25, -1, 0, 0, -0.25, 0, 0}},
      {"depth_inside_short", "sphere_box_penetration", with({0.75, 0, 0, 1}, cube), false, true, {1, -1, 0, 0, -0.25, 0, 0}},
      // On the edge: the nearest point with any normal between the faces, or the way out of either face.
      {"depth_on_edge", "sphere_box_penetration", with({1, 1, 0, 1}, cube), true, true, {1, -0.6, -0.8, 0, 1, 1, 0}},
      {"depth_on_edge_face", "sphere_box_penetration", with({1, 1, 0, 1}, cube), true, true, {1, 0, -1, 0, 1, 0, 0}},

      // sphere, velocity, time, location, normal. Falling onto the ground: up again.
      {"bounce_up", "bounce_direction", {0, 0, 3, 1, 3, 0, -4, 0.5, 1.5, 0, 0, 0, 0, 1}, true, true, {0.6, 0, 0.8}},
      {"no_bounce", "bounce_direction", {0, 0, 3, 1, 3, 0, -4, 0.5, 1.5, 0, 0, 0, 0, 1}, false, true, {0.6, 0, -0.8}},
      // The center is at the location: the normal (0, 0, 2) counts, of any length.
      {"given_normal", "bounce_direction", {0, 0, 0, 1, 3, 0, -4, 0, 0, 0, 0, 0, 0, 2}, true, true, {0.6, 0, 0.8}},
      {"at_rest", "bounce_direction", {0, 0, 3, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1}, true, true, {0, 0, 0}},
  };
}

INSTANTIATE_TEST_SUITE_P(Derived, ByHand, testing::ValuesIn(hands()),
                         [](const auto& test) { return std::string(test.param.query) + "_" + test.param.name; });

}  // namespace
}  // namespace nearmiss
