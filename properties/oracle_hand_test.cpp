/// Answers derived by hand: each right one must agree, each wrong one must be refuted. The numbers are
/// small integers, so that the right answer is exact, and the derivation stands beside it. A name begins with what the
/// case is of its query: a clear hit (of a query without a decision, the plain case), a clear miss, an exact touch, a
/// start inside, a tie of several right answers, a degenerate shape, a gate. Which of these each query has is a table
/// below.
#include <gtest/gtest.h>

#include <iterator>
#include <map>
#include <set>
#include <sstream>
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

// A case a line.
// clang-format off

// closest_point_segment: v0, v1, point.
const std::vector<double> diagonal{0, 0, 0, 2, 2, 0};
std::vector<double> operator+(std::vector<double> a, const std::vector<double>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}
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
      {"hit_foot", "closest_point_segment", with(diagonal, {2, 0, 0}), true, true, {1, 1, 0}},
      {"hit_foot_off", "closest_point_segment", with(diagonal, {2, 0, 0}), false, true, {1, 1, 0.001}},
      {"hit_before_v0", "closest_point_segment", with(diagonal, {-1, -1, 5}), true, true, {0, 0, 0}},
      {"touch_at_v1", "closest_point_segment", with(diagonal, {3, 1, 7}), true, true, {2, 2, 0}},
      {"degenerate_point", "closest_point_segment", {1, 2, 3, 1, 2, 3, 9, 9, 9}, true, true, {1, 2, 3}},

      // From (1, 1, 2) downward at speed 1: the plane after 2, inside since 1 + 1 < 4.
      {"hit_face", "moving_point_triangle", with({1, 1, 2, 0, 0, -1}, triangle), true, true, {2, 1, 1, 0, 0, 0, 1}},
      {"hit_face_late", "moving_point_triangle", with({1, 1, 2, 0, 0, -1}, triangle), false, true, {2.25, 1, 1, 0, 0, 0, 1}},
      {"hit_face_flipped", "moving_point_triangle", with({1, 1, 2, 0, 0, -1}, triangle), false, true, {2, 1, 1, 0, 0, 0, -1}},
      // (2, 2) lies on the edge x + y = 4: closed.
      {"touch_edge", "moving_point_triangle", with({2, 2, 2, 0, 0, -1}, triangle), true, true, {2, 2, 2, 0, 0, 0, 1}},
      {"touch_vertex", "moving_point_triangle", with({4, 0, 2, 0, 0, -1}, triangle), true, true, {2, 4, 0, 0, 0, 0, 1}},
      {"miss_beside", "moving_point_triangle", with({3, 2, 2, 0, 0, -1}, triangle), true, false, {inf}},
      {"gate_from_behind", "moving_point_triangle", with({1, 1, -2, 0, 0, 1}, triangle), true, false, {inf}},
      {"gate_along", "moving_point_triangle", with({1, 1, 0, 1, 0, 0}, triangle), true, false, {inf}},
      {"touch_at_start", "moving_point_triangle", with({1, 1, 0, 0, 0, -1}, triangle), true, true, {0, 1, 1, 0, 0, 0, 1}},
      {"degenerate_segment", "moving_point_triangle", {1, 0, 2, 0, 0, -1, 0, 0, 0, 1, 0, 0, 2, 0, 0}, true, false, {inf}},

      // point, velocity, center, radius, solid. From (-5, 0, 0) at speed 2 to the sphere of radius 3 at 0:
      // x = -3 after 1.
      {"hit_head_on", "moving_point_sphere", {-5, 0, 0, 2, 0, 0, 0, 0, 0, 3, 1}, true, true, {1, -3, 0, 0, -1, 0, 0}},
      // At height 3 the line touches in (0, 3, 0).
      {"touch_tangent", "moving_point_sphere", {-5, 3, 0, 1, 0, 0, 0, 0, 0, 3, 1}, true, true, {5, 0, 3, 0, 0, 1, 0}},
      {"touch_tangent_missed", "moving_point_sphere", {-5, 3, 0, 1, 0, 0, 0, 0, 0, 3, 1}, false, false, {inf}},
      {"inside_solid", "moving_point_sphere", {1, 0, 0, 1, 0, 0, 0, 0, 0, 3, 1}, true, true, {0, 1, 0, 0, 1, 0, 0}},
      {"inside_hollow", "moving_point_sphere", {1, 0, 0, 1, 0, 0, 0, 0, 0, 3, 0}, true, true, {2, 3, 0, 0, 1, 0, 0}},
      // On the surface and leaving: the exit is now. Entering: the chord (-3..3) is left after 6.
      {"touch_hollow_leaving", "moving_point_sphere", {3, 0, 0, 1, 0, 0, 0, 0, 0, 3, 0}, true, true, {0, 3, 0, 0, 1, 0, 0}},
      {"touch_hollow_entering", "moving_point_sphere", {3, 0, 0, -1, 0, 0, 0, 0, 0, 3, 0}, true, true, {6, -3, 0, 0, -1, 0, 0}},
      {"tie_at_the_center", "moving_point_sphere", {0, 0, 0, 1, 0, 0, 0, 0, 0, 3, 1}, true, true, {0, 0, 0, 0, 0, 0.6, 0.8}},
      {"gate_at_rest_outside", "moving_point_sphere", {5, 0, 0, 0, 0, 0, 0, 0, 0, 3, 1}, true, false, {inf}},
      {"gate_at_rest_in_hollow", "moving_point_sphere", {1, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0}, true, false, {inf}},

      // Radius 1 from x = 5 at speed 1: centers 2 apart after 3, contact on the face x = 1.
      {"hit_face", "moving_sphere_box", with({5, 0, 0, 1, -1, 0, 0}, cube), true, true, {3, 1, 0, 0, 1, 0, 0}},
      // At y = 2 exactly the sphere grazes the face y = 1 from x = 1 on: first over the edge, distance 1.
      {"touch_graze", "moving_sphere_box", with({5, 2, 0, 1, -1, 0, 0}, cube), true, true, {4, 1, 1, 0, 0, 1, 0}},
      {"touch_graze_at_its_end", "moving_sphere_box", with({5, 2, 0, 1, -1, 0, 0}, cube), false, true, {6, -1, 1, 0, 0, 1, 0}},
      // From the edge (1, 1, *) the center (4, 5) is (3, 4) away: radius 5 touches at the start.
      {"touch_at_edge", "moving_sphere_box", with({4, 5, 0, 5, -1, 0, 0}, cube), true, true, {0, 1, 1, 0, 0.6, 0.8, 0}},
      {"touch_and_leave", "moving_sphere_box", with({4, 5, 0, 5, 1, 0, 0}, cube), true, false, {inf}},
      {"touch_and_slide", "moving_sphere_box", with({4, 5, 0, 5, 0, 0, 1}, cube), true, true, {0, 1, 1, 0, 0.6, 0.8, 0}},
      {"inside_overlap_leaving", "moving_sphere_box", with({1.5, 0, 0, 1, 7, 0, 0}, cube), true, true, {0, 1, 0, 0, 1, 0, 0}},
      // Center inside, nearest face x = 1; at the center of the cube any of six faces is nearest.
      {"inside_center", "moving_sphere_box", with({0.5, 0, 0, 1, 0, 0, 1}, cube), true, true, {0, 1, 0, 0, 1, 0, 0}},
      {"tie_in_the_middle", "moving_sphere_box", with({0, 0, 0, 1, 0, 0, 1}, cube), true, true, {0, 0, 0, -1, 0, 0, -1}},
      {"inside_no_such_face", "moving_sphere_box", with({0.5, 0, 0, 1, 0, 0, 1}, cube), false, true, {0, -1, 0, 0, -1, 0, 0}},
      // Center on the edge x = y = 1: any normal between both faces that does not lead along the motion; where both do, any.
      {"tie_on_edge", "moving_sphere_box", with({1, 1, 0, 1, 1, -2, 0}, cube), true, true, {0, 1, 1, 0, r2, r2, 0}},
      {"tie_on_edge_that_is_left", "moving_sphere_box", with({1, 1, 0, 1, 1, -2, 0}, cube), false, true, {0, 1, 1, 0, 1, 0, 0}},
      {"tie_on_edge_leaving", "moving_sphere_box", with({1, 1, 0, 1, 1, 1, 0}, cube), true, true, {0, 1, 1, 0, 0.6, 0.8, 0}},
      // A point that hits the vertex (1, 1, 1) along the diagonal: any normal of the octant is right.
      {"degenerate_point_at_vertex", "moving_sphere_box", with({3, 3, 3, 0, -1, -1, -1}, cube), true, true, {2, 1, 1, 1, r2, 0, r2}},
      {"degenerate_point_at_vertex_inward", "moving_sphere_box", with({3, 3, 3, 0, -1, -1, -1}, cube), false, true, {2, 1, 1, 1, r2, 0, -r2}},
      {"degenerate_point_inside", "moving_sphere_box", with({0, 0, 0, 0, 1, 0, 0}, cube), true, false, {inf}},
      {"degenerate_point_on_face_entering", "moving_sphere_box", with({1, 0, 0, 0, -1, 0, 0}, cube), true, true, {0, 1, 0, 0, 1, 0, 0}},
      {"degenerate_point_on_face_leaving", "moving_sphere_box", with({1, 0, 0, 0, 1, 0, 0}, cube), true, false, {inf}},
      // Along the turned box's first axis (3, 4) / 5 from distance 10 at speed 5: 2 apart after 8/5.
      {"hit_turned_face", "moving_sphere_box", with({6, 8, 0, 1, -3, -4, 0}, turned), true, true, {1.6, 0.6, 0.8, 0, 0.6, 0.8, 0}},

      // Two cubes; they share the vertex (1, 1, 1), then are an ulp apart.
      {"touch_vertex", "box_box_overlap", with(with(cube, {2, 2, 2, 1, 1, 1, 0, 0, 0, 1}), {-1}), true, true, {}},
      {"miss_by_an_ulp", "box_box_overlap", with(with(cube, {2 + 0x1p-51, 2, 2, 1, 1, 1, 0, 0, 0, 1}), {-1}), true, false, {}},
      {"gate_no_hint", "box_box_overlap", with(with(cube, {2, 2, 2, 1, 1, 1, 0, 0, 0, 1}), {14}), true, true, {}},
      // A turned cube of half extent 5 reaches 5 (3 + 4) / 5 = 7 along x, and the other one 1.
      {"miss_turned", "box_box_overlap", with(with(cube, {12, 0, 0, 5, 5, 5, 0, 0, 1, 2}), {-1}), false, true, {}},
      {"touch_turned", "box_box_overlap", with(with(cube, {8, 0, 0, 5, 5, 5, 0, 0, 1, 2}), {-1}), true, true, {}},

      // center, radius, cube. Outside by 2 with radius 3: depth 1, into the box along -x.
      {"hit_outside", "sphere_box_penetration", with({3, 0, 0, 3}, cube), true, true, {1, -1, 0, 0, 1, 0, 0}},
      {"touch_at_edge", "sphere_box_penetration", with({4, 5, 0, 5}, cube), true, true, {0, -0.6, -0.8, 0, 1, 1, 0}},
      {"miss_apart", "sphere_box_penetration", with({4, 5, 0, 4}, cube), true, false, {-1}},
      // Inside by 1/4 below the face x = 1: depth 1 + 1/4, deepest point 1 further in.
      {"inside_below_face", "sphere_box_penetration", with({0.75, 0, 0, 1}, cube), true, true, {1.25, -1, 0, 0, -0.25, 0, 0}},
      {"inside_short", "sphere_box_penetration", with({0.75, 0, 0, 1}, cube), false, true, {1, -1, 0, 0, -0.25, 0, 0}},
      // On the edge: the nearest point with any normal between the faces, or the way out of either face.
      {"tie_on_edge", "sphere_box_penetration", with({1, 1, 0, 1}, cube), true, true, {1, -0.6, -0.8, 0, 1, 1, 0}},
      {"tie_on_edge_face", "sphere_box_penetration", with({1, 1, 0, 1}, cube), true, true, {1, 0, -1, 0, 1, 0, 0}},

      // sphere, velocity, time, location, normal. Falling onto the ground: up again.
      {"hit_up", "bounce_direction", {0, 0, 3, 1, 3, 0, -4, 0.5, 1.5, 0, 0, 0, 0, 1}, true, true, {0.6, 0, 0.8}},
      {"hit_none", "bounce_direction", {0, 0, 3, 1, 3, 0, -4, 0.5, 1.5, 0, 0, 0, 0, 1}, false, true, {0.6, 0, -0.8}},
      // The center is at the location: the normal (0, 0, 2) counts, of any length.
      {"gate_given_normal", "bounce_direction", {0, 0, 0, 1, 3, 0, -4, 0, 0, 0, 0, 0, 0, 2}, true, true, {0.6, 0, 0.8}},
      {"degenerate_at_rest", "bounce_direction", {0, 0, 3, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1}, true, true, {0, 0, 0}},
  };
}

using Numbers = std::vector<double>;

// Two corners of a right angle in the plane z = 0, and the flat things without area.
const Numbers flat_triangle{0, 0, 0, 4, 0, 0, 2, 0, 0};
const Numbers flat_rectangle{0, 0, 0, 1, 0, 0, 4, 0, 0, 2, 0, 0};
const Numbers rectangle{0, 0, 0, 4, 0, 0, 4, 2, 0, 0, 2, 0};
/// Folded along the z axis: the triangle v0 v1 v2 in y = 0, the triangle v0 v2 v3 in x = 0.
const Numbers folded{0, 0, 0, 4, 0, 0, 0, 0, 4, 0, 4, 0};
const Numbers ground{0, 0, 1, 0};
const Numbers tube{0, 0, 0, 4, 0, 0, 1};
const Numbers aligned{-1, -1, -1, 1, 1, 1};
const Numbers flat_box{0, 0, 0, 1, 1, 0, 0, 0, 0, 1};
const Numbers point_box{0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
Numbers cube_at(double x, double y, double z) { return {x, y, z, 1, 1, 1, 0, 0, 0, 1}; }

std::vector<Hand> hands_of_points() {
  return {
      // On the segment already.
      {"touch_on_it", "closest_point_segment", diagonal + Numbers{1, 1, 0}, true, true, {1, 1, 0}},
      // As above: the foot is the middle; (3, 1, 7) - (2, 2, 0) = (1, -1, 7) is at a right angle to (2, 2, 0).
      {"hit_foot", "closest_point_segment_unit", diagonal + Numbers{2, 0, 0}, true, true, {1, 1, 0}},
      {"hit_foot_off", "closest_point_segment_unit", diagonal + Numbers{2, 0, 0}, false, true, {1.5, 0.5, 0}},
      {"hit_before_v0", "closest_point_segment_unit", diagonal + Numbers{-1, -1, 5}, true, true, {0, 0, 0}},
      {"touch_at_v1", "closest_point_segment_unit", diagonal + Numbers{3, 1, 7}, true, true, {2, 2, 0}},
      {"degenerate_point", "closest_point_segment_unit", {1, 2, 3, 1, 2, 3, 9, 9, 9}, true, true, {1, 2, 3}},

      // Below the side y = 0; on the side x + y = 4; beyond its end (4, 0).
      {"hit_below", "closest_point_triangle_perimeter", triangle + Numbers{1, -1, 0}, true, true, {1, 0, 0}},
      {"hit_below_off", "closest_point_triangle_perimeter", triangle + Numbers{1, -1, 0}, false, true, {0, 0, 0}},
      {"touch_on_side", "closest_point_triangle_perimeter", triangle + Numbers{3, 1, 0}, true, true, {3, 1, 0}},
      {"touch_vertex", "closest_point_triangle_perimeter", triangle + Numbers{5, -1, 0}, true, true, {4, 0, 0}},
      // Above (1, 1): 1 from two sides, sqrt(2) from the third in (2, 2, 0).
      {"tie_one", "closest_point_triangle_perimeter", triangle + Numbers{1, 1, 5}, true, true, {1, 0, 0}},
      {"tie_other", "closest_point_triangle_perimeter", triangle + Numbers{1, 1, 5}, true, true, {0, 1, 0}},
      {"tie_third", "closest_point_triangle_perimeter", triangle + Numbers{1, 1, 5}, false, true, {2, 2, 0}},
      {"degenerate_segment", "closest_point_triangle_perimeter", flat_triangle + Numbers{1, 3, 0}, true, true, {1, 0, 0}},
      {"degenerate_point", "closest_point_triangle_perimeter", {1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0}, true, true, {1, 1, 1}},
      // The same with the edge: 0 is y = 0, 1 is x + y = 4, 2 is x = 0. A vertex is on two of them.
      {"hit_below", "closest_point_triangle_perimeter_edges", triangle + Numbers{1, -1, 0}, true, true, {1, 0, 0, 0}},
      {"hit_below_edge", "closest_point_triangle_perimeter_edges", triangle + Numbers{1, -1, 0}, false, true, {1, 0, 0, 1}},
      {"touch_on_side", "closest_point_triangle_perimeter_edges", triangle + Numbers{3, 1, 0}, true, true, {3, 1, 0, 1}},
      {"tie_vertex_0", "closest_point_triangle_perimeter_edges", triangle + Numbers{5, -1, 0}, true, true, {4, 0, 0, 0}},
      {"tie_vertex_1", "closest_point_triangle_perimeter_edges", triangle + Numbers{5, -1, 0}, true, true, {4, 0, 0, 1}},
      {"tie_vertex_2", "closest_point_triangle_perimeter_edges", triangle + Numbers{5, -1, 0}, false, true, {4, 0, 0, 2}},
      {"tie_sides", "closest_point_triangle_perimeter_edges", triangle + Numbers{1, 1, 5}, true, true, {0, 1, 0, 2}},
      // Corners at x = 0, 4, 2: (1, 0, 0) is on the edges 0-4 and 2-0, not on 4-2.
      {"degenerate_segment", "closest_point_triangle_perimeter_edges", flat_triangle + Numbers{1, 3, 0}, true, true, {1, 0, 0, 2}},
      {"degenerate_segment_edge", "closest_point_triangle_perimeter_edges", flat_triangle + Numbers{1, 3, 0}, false, true, {1, 0, 0, 1}},

      {"hit_above", "closest_point_rectangle", rectangle + Numbers{3, 1, 5}, true, true, {3, 1, 0}},
      {"hit_above_off", "closest_point_rectangle", rectangle + Numbers{3, 1, 5}, false, true, {3, 1.5, 0}},
      {"hit_beside", "closest_point_rectangle", rectangle + Numbers{6, 1, 0}, true, true, {4, 1, 0}},
      {"touch_on_side", "closest_point_rectangle", rectangle + Numbers{4, 1, 0}, true, true, {4, 1, 0}},
      // 1 from the plane of either half; the fold (0, 0, 1) is sqrt(2) away.
      {"tie_one_half", "closest_point_rectangle", folded + Numbers{1, 1, 1}, true, true, {1, 0, 1}},
      {"tie_other_half", "closest_point_rectangle", folded + Numbers{1, 1, 1}, true, true, {0, 1, 1}},
      {"tie_fold", "closest_point_rectangle", folded + Numbers{1, 1, 1}, false, true, {0, 0, 1}},
      {"degenerate_segment", "closest_point_rectangle", flat_rectangle + Numbers{3, 2, 0}, true, true, {3, 0, 0}},
      {"hit_above", "closest_point_rectangle_perimeter", rectangle + Numbers{3, 0.5, 5}, true, true, {3, 0, 0}},
      {"hit_not_the_inside", "closest_point_rectangle_perimeter", rectangle + Numbers{3, 0.5, 5}, false, true, {3, 0.5, 0}},
      {"touch_on_side", "closest_point_rectangle_perimeter", rectangle + Numbers{4, 1, 0}, true, true, {4, 1, 0}},
      // From the middle 1 to the long sides, 2 to the short ones.
      {"tie_below", "closest_point_rectangle_perimeter", rectangle + Numbers{2, 1, 5}, true, true, {2, 0, 0}},
      {"tie_above", "closest_point_rectangle_perimeter", rectangle + Numbers{2, 1, 5}, true, true, {2, 2, 0}},
      {"tie_short_side", "closest_point_rectangle_perimeter", rectangle + Numbers{2, 1, 5}, false, true, {0, 1, 0}},
      {"degenerate_segment", "closest_point_rectangle_perimeter", flat_rectangle + Numbers{3, 2, 0}, true, true, {3, 0, 0}},

      // The x axis and x = 1 at height 3; two diagonals that cross; parallels: line 1's own point.
      {"hit_skew", "closest_points_lines", {0, 0, 0, 2, 0, 0, 1, 5, 3, 0, -4, 0}, true, true, {1, 0, 0, 1, 0, 3}},
      {"hit_skew_off", "closest_points_lines", {0, 0, 0, 2, 0, 0, 1, 5, 3, 0, -4, 0}, false, true, {0, 0, 0, 1, 0, 3}},
      {"touch_crossing", "closest_points_lines", {0, 0, 0, 1, 1, 0, 4, 0, 0, -1, 1, 0}, true, true, {2, 2, 0, 2, 2, 0}},
      {"tie_parallel", "closest_points_lines", {7, 0, 0, 1, 0, 0, 0, 2, 0, -3, 0, 0}, true, true, {7, 0, 0, 7, 2, 0}},
      {"tie_parallel_elsewhere", "closest_points_lines", {7, 0, 0, 1, 0, 0, 0, 2, 0, -3, 0, 0}, false, true, {0, 0, 0, 0, 2, 0}},
      {"degenerate_same_line", "closest_points_lines", {1, 0, 0, 1, 0, 0, 5, 0, 0, 2, 0, 0}, true, true, {1, 0, 0, 1, 0, 0}},

      // Triangle, normal, axis, point. (1, 1) = 1/2 (0, 0) + 1/4 (4, 0) + 1/4 (0, 4), whatever the height.
      {"hit_inside", "point_in_triangle", triangle + Numbers{0, 0, 1, -1, 1, 1, 9}, true, true, {0.5, 0.25, 0.25}},
      {"hit_inside_weights", "point_in_triangle", triangle + Numbers{0, 0, 1, -1, 1, 1, 9}, false, true, {0.25, 0.5, 0.25}},
      {"miss_beside", "point_in_triangle", triangle + Numbers{0, 0, 1, -1, 3, 3, 0}, true, false, {}},
      {"touch_edge", "point_in_triangle", triangle + Numbers{0, 0, 1, -1, 2, 2, 0}, true, true, {0, 0.5, 0.5}},
      {"touch_vertex", "point_in_triangle", triangle + Numbers{0, 0, 1, -1, 4, 0, 0}, true, true, {0, 1, 0}},
      // Of equal components x counts: seen along x the triangle is the segment z = 0, y from 0 to 4.
      {"tie_of_components", "point_in_triangle", triangle + Numbers{1, 1, 1, -1, 1, 1, 1}, true, false, {}},
      {"tie_of_components_inside", "point_in_triangle", triangle + Numbers{1, 1, 1, -1, 9, 1, 0}, true, true, {}},
      // The given axis counts, not the normal. On the segment y = 1 needs 1/4 of v2 and 3/4 of v0 and v1 in any parts.
      {"gate_given_axis", "point_in_triangle", triangle + Numbers{0, 0, 1, 0, 1, 1, 1}, true, false, {}},
      {"degenerate_seen_edge_on", "point_in_triangle", triangle + Numbers{0, 0, 1, 0, 9, 1, 0}, true, true, {0.5, 0.25, 0.25}},
      {"degenerate_weights", "point_in_triangle", triangle + Numbers{0, 0, 1, 0, 9, 1, 0}, false, true, {0.25, 0.25, 0.5}},
      // Either half of the rectangle; on its diagonal both.
      {"hit_first_half", "point_in_rectangle", rectangle + Numbers{0, 0, 1, 3, 1, 7}, true, true, {}},
      {"hit_second_half", "point_in_rectangle", rectangle + Numbers{0, 0, 1, 1, 1.5, 7}, true, true, {}},
      {"hit_denied", "point_in_rectangle", rectangle + Numbers{0, 0, 1, 1, 1.5, 7}, false, false, {}},
      {"miss_beside", "point_in_rectangle", rectangle + Numbers{0, 0, 1, 5, 1, 0}, true, false, {}},
      {"touch_side", "point_in_rectangle", rectangle + Numbers{0, 0, 1, 4, 1, 0}, true, true, {}},
      {"touch_diagonal", "point_in_rectangle", rectangle + Numbers{0, 0, 1, 2, 1, 0}, true, true, {}},
      {"tie_of_components", "point_in_rectangle", rectangle + Numbers{1, 1, 1, 1, 1, 1}, true, false, {}},
      {"tie_of_components_inside", "point_in_rectangle", rectangle + Numbers{1, 1, 1, 9, 1, 0}, true, true, {}},
      // v0 = v1 leaves the half above the diagonal, and the diagonal.
      {"degenerate_half", "point_in_rectangle", {0, 0, 0, 0, 0, 0, 4, 2, 0, 0, 2, 0, 0, 0, 1, 1, 1.5, 0}, true, true, {}},
      {"degenerate_other_half", "point_in_rectangle", {0, 0, 0, 0, 0, 0, 4, 2, 0, 0, 2, 0, 0, 0, 1, 3, 1, 0}, true, false, {}},
  };
}

std::vector<Hand> hands_of_moving_points() {
  return {
      // The plane z = 1 by a normal of length 2; from height 4 above it at speed 2: after 2.
      {"hit_down", "moving_point_plane", {1, 2, 5, 0, 0, -2, 0, 0, 2, -2}, true, true, {2, 1, 2, 1, 0, 0, 1}},
      {"hit_late", "moving_point_plane", {1, 2, 5, 0, 0, -2, 0, 0, 2, -2}, false, true, {2.5, 1, 2, 1, 0, 0, 1}},
      {"miss_along", "moving_point_plane", {1, 2, 5, 1, 0, 0, 0, 0, 2, -2}, true, false, {inf}},
      {"touch_at_start", "moving_point_plane", {1, 2, 1, 0, 0, -2, 0, 0, 2, -2}, true, true, {0, 1, 2, 1, 0, 0, 1}},
      {"gate_leaving", "moving_point_plane", {1, 2, 1, 0, 0, 2, 0, 0, 2, -2}, true, false, {inf}},
      {"gate_along_on_it", "moving_point_plane", {1, 2, 1, 1, 0, 0, 0, 0, 2, -2}, true, false, {inf}},
      {"gate_behind", "moving_point_plane", {1, 2, 0, 0, 0, -2, 0, 0, 2, -2}, true, false, {inf}},

      // As the plain triangle above.
      {"hit_face", "moving_point_triangle_prepared", Numbers{1, 1, 2, 0, 0, -1} + triangle, true, true, {2, 1, 1, 0, 0, 0, 1}},
      {"hit_flipped", "moving_point_triangle_prepared", Numbers{1, 1, 2, 0, 0, -1} + triangle, false, true, {2, 1, 1, 0, 0, 0, -1}},
      {"miss_beside", "moving_point_triangle_prepared", Numbers{3, 2, 2, 0, 0, -1} + triangle, true, false, {inf}},
      {"touch_edge", "moving_point_triangle_prepared", Numbers{2, 2, 2, 0, 0, -1} + triangle, true, true, {2, 2, 2, 0, 0, 0, 1}},
      {"touch_vertex", "moving_point_triangle_prepared", Numbers{0, 4, 2, 0, 0, -1} + triangle, true, true, {2, 0, 4, 0, 0, 0, 1}},
      {"gate_from_behind", "moving_point_triangle_prepared", Numbers{1, 1, -2, 0, 0, 1} + triangle, true, false, {inf}},
      {"gate_along", "moving_point_triangle_prepared", Numbers{1, 1, 0, 1, 0, 0} + triangle, true, false, {inf}},
      {"degenerate_segment", "moving_point_triangle_prepared", Numbers{1, 0, 2, 0, 0, -1} + flat_triangle, true, false, {inf}},

      // Right of the diagonal y = x / 2 the first half, left of it the second, on it both.
      {"hit_first_half", "moving_point_rectangle", Numbers{3, 1, 2, 0, 0, -1} + rectangle, true, true, {2, 3, 1, 0, 0, 0, 1}},
      {"hit_second_half", "moving_point_rectangle", Numbers{1, 1.5, 2, 0, 0, -1} + rectangle, true, true, {2, 1, 1.5, 0, 0, 0, 1}},
      {"hit_denied", "moving_point_rectangle", Numbers{1, 1.5, 2, 0, 0, -1} + rectangle, false, false, {inf}},
      {"miss_beside", "moving_point_rectangle", Numbers{5, 1, 2, 0, 0, -1} + rectangle, true, false, {inf}},
      {"touch_side", "moving_point_rectangle", Numbers{4, 1, 2, 0, 0, -1} + rectangle, true, true, {2, 4, 1, 0, 0, 0, 1}},
      {"touch_diagonal", "moving_point_rectangle", Numbers{2, 1, 2, 0, 0, -1} + rectangle, true, true, {2, 2, 1, 0, 0, 0, 1}},
      // At the fold both halves are met at once: (1, 1, 1) - t (1, 1, 0) is (0, 0, 1) at t = 1. The first half lies in
      // y = 0 with normal (4, 0, 0) x (0, 0, 4) = (0, -16, 0), so this is its back; the second has (0, 0, 4) x (0, 4, 0) =
      // (-16, 0, 0): its back as well. From the other side both fronts.
      {"tie_first_half", "moving_point_rectangle", Numbers{-1, -1, 1, 1, 1, 0} + folded, true, true, {1, 0, 0, 1, 0, -1, 0}},
      {"tie_second_half", "moving_point_rectangle", Numbers{-1, -1, 1, 1, 1, 0} + folded, true, true, {1, 0, 0, 1, -1, 0, 0}},
      {"tie_between", "moving_point_rectangle", Numbers{-1, -1, 1, 1, 1, 0} + folded, false, true, {1, 0, 0, 1, -r2, -r2, 0}},
      {"gate_both_backs", "moving_point_rectangle", Numbers{1, 1, 1, -1, -1, 0} + folded, true, false, {inf}},
      {"gate_from_below", "moving_point_rectangle", Numbers{3, 1, -2, 0, 0, 1} + rectangle, true, false, {inf}},
      {"degenerate_segment", "moving_point_rectangle", Numbers{3, 0, 2, 0, 0, -1} + flat_rectangle, true, false, {inf}},
      {"degenerate_half", "moving_point_rectangle", {1, 1.5, 2, 0, 0, -1, 0, 0, 0, 0, 0, 0, 4, 2, 0, 0, 2, 0}, true, true, {2, 1, 1.5, 0, 0, 0, 1}},
      {"degenerate_other_half", "moving_point_rectangle", {3, 1, 2, 0, 0, -1, 0, 0, 0, 0, 0, 0, 4, 2, 0, 0, 2, 0}, true, false, {inf}},

      {"miss_above", "moving_point_sphere", {-5, 4, 0, 1, 0, 0, 0, 0, 0, 3, 1}, true, false, {inf}},
      // A ball of radius 0 is its center: any normal.
      {"degenerate_point", "moving_point_sphere", {-5, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1}, true, true, {5, 0, 0, 0, 0, 0.6, 0.8}},
      {"degenerate_point_missed", "moving_point_sphere", {-5, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1}, true, false, {inf}},

      // Down onto the tube: its top at height 1 after 4. Along the axis onto the end at x = 5 after 2.
      {"hit_tube", "moving_point_capsule", Numbers{2, 0, 5, 0, 0, -1} + tube, true, true, {4, 2, 0, 1, 0, 0, 1}},
      {"hit_tube_early", "moving_point_capsule", Numbers{2, 0, 5, 0, 0, -1} + tube, false, true, {3.5, 2, 0, 1, 0, 0, 1}},
      {"hit_end", "moving_point_capsule", Numbers{9, 0, 0, -2, 0, 0} + tube, true, true, {2, 5, 0, 0, 1, 0, 0}},
      {"miss_beside", "moving_point_capsule", Numbers{2, 2, 5, 0, 0, -1} + tube, true, false, {inf}},
      {"touch_tangent", "moving_point_capsule", Numbers{2, 1, 5, 0, 0, -1} + tube, true, true, {5, 2, 1, 0, 0, 1, 0}},
      {"touch_entering", "moving_point_capsule", Numbers{2, 0, 1, 0, 0, -1} + tube, true, true, {0, 2, 0, 1, 0, 0, 1}},
      {"touch_sliding", "moving_point_capsule", Numbers{2, 0, 1, 1, 0, 0} + tube, true, true, {0, 2, 0, 1, 0, 0, 1}},
      {"touch_leaving", "moving_point_capsule", Numbers{2, 0, 1, 0, 0, 1} + tube, true, false, {inf}},
      {"inside_never_enters", "moving_point_capsule", Numbers{2, 0, 0.5, 0, 0, 1} + tube, true, false, {inf}},
      // Radius 0: the segment, with any normal at a right angle to it.
      {"tie_of_normals", "moving_point_capsule", {2, 0, 5, 0, 0, -1, 0, 0, 0, 4, 0, 0, 0}, true, true, {5, 2, 0, 0, 0, 0.6, 0.8}},
      {"tie_of_normals_along", "moving_point_capsule", {2, 0, 5, 0, 0, -1, 0, 0, 0, 4, 0, 0, 0}, false, true, {5, 2, 0, 0, 0.6, 0, 0.8}},
      {"degenerate_segment", "moving_point_capsule", {2, 0, 5, 0, 0, -1, 0, 0, 0, 4, 0, 0, 0}, true, true, {5, 2, 0, 0, 0, 0, 1}},
      {"degenerate_ball", "moving_point_capsule", {3, 0, 0, -1, 0, 0, 0, 0, 0, 0, 0, 0, 1}, true, true, {2, 1, 0, 0, 1, 0, 0}},

      {"hit_face", "moving_point_box", Numbers{3, 0, 0, -1, 0, 0} + cube, true, true, {2, 1, 0, 0, 1, 0, 0}},
      {"hit_face_late", "moving_point_box", Numbers{3, 0, 0, -1, 0, 0} + cube, false, true, {4, -1, 0, 0, -1, 0, 0}},
      // Along the turned box's first axis (3, 4) / 5 from distance 10 at speed 5: 1 away after 9/5.
      {"hit_turned_face", "moving_point_box", Numbers{6, 8, 0, -3, -4, 0} + turned, true, true, {1.8, 0.6, 0.8, 0, 0.6, 0.8, 0}},
      {"miss_beside", "moving_point_box", Numbers{3, 2, 0, -1, 0, 0} + cube, true, false, {inf}},
      // In the plane of the face y = 1, and past the edge x = y = 1 only.
      {"touch_sliding_in", "moving_point_box", Numbers{3, 1, 0, -1, 0, 0} + cube, true, true, {2, 1, 1, 0, 1, 0, 0}},
      {"touch_edge_in_passing", "moving_point_box", Numbers{3, -1, 0, -1, 1, 0} + cube, true, true, {2, 1, 1, 0, r2, r2, 0}},
      {"touch_entering", "moving_point_box", Numbers{1, 0, 0, -1, 0, 0} + cube, true, true, {0, 1, 0, 0, 1, 0, 0}},
      {"touch_leaving", "moving_point_box", Numbers{1, 0, 0, 1, 0, 0} + cube, true, false, {inf}},
      {"inside_never_enters", "moving_point_box", Numbers{0.5, 0, 0, 1, 0, 0} + cube, true, false, {inf}},
      // At the edge any normal between x and y, at the vertex any of the octant.
      {"tie_edge", "moving_point_box", Numbers{3, 1, 0, -1, 0, 0} + cube, true, true, {2, 1, 1, 0, 0, 1, 0}},
      {"tie_edge_along", "moving_point_box", Numbers{3, 1, 0, -1, 0, 0} + cube, false, true, {2, 1, 1, 0, 0, 0, 1}},
      {"tie_vertex", "moving_point_box", Numbers{3, 3, 3, -1, -1, -1} + cube, true, true, {2, 1, 1, 1, r2, 0, r2}},
      // Flat: all surface, with a normal up and one down.
      {"degenerate_flat", "moving_point_box", Numbers{0, 0, 2, 0, 0, -1} + flat_box, true, true, {2, 0, 0, 0, 0, 0, 1}},
      {"degenerate_flat_start", "moving_point_box", Numbers{0, 0, 0, 0, 0, 1} + flat_box, true, true, {0, 0, 0, 0, 0, 0, -1}},
      {"degenerate_point", "moving_point_box", Numbers{0, 0, 2, 0, 0, -1} + point_box, true, true, {2, 0, 0, 0, 0, 0, 1}},

      // inside, location, time, normal. A start in the closed box is a miss with `inside`.
      {"hit_face", "moving_point_aabox", Numbers{3, 0, 0, -1, 0, 0} + aligned, true, true, {0, 1, 0, 0, 2, 1, 0, 0}},
      {"hit_face_late", "moving_point_aabox", Numbers{3, 0, 0, -1, 0, 0} + aligned, false, true, {0, 1, 0, 0, 4, 1, 0, 0}},
      {"miss_beside", "moving_point_aabox", Numbers{3, 2, 0, -1, 0, 0} + aligned, true, false, {0}},
      {"touch_edge", "moving_point_aabox", Numbers{3, 1, 0, -1, 0, 0} + aligned, true, true, {0, 1, 1, 0, 2, 1, 0, 0}},
      {"touch_at_start", "moving_point_aabox", Numbers{1, 0, 0, -1, 0, 0} + aligned, true, false, {1, 1, 0, 0}},
      {"inside_told", "moving_point_aabox", Numbers{0.5, 0, 0, 1, 0, 0} + aligned, true, false, {1, 0.5, 0, 0}},
      {"inside_not_told", "moving_point_aabox", Numbers{0.5, 0, 0, 1, 0, 0} + aligned, false, false, {0, 0.5, 0, 0}},
      // At the edge the normal of either face, none between.
      {"tie_x", "moving_point_aabox", Numbers{3, 3, 0, -1, -1, 0} + aligned, true, true, {0, 1, 1, 0, 2, 1, 0, 0}},
      {"tie_y", "moving_point_aabox", Numbers{3, 3, 0, -1, -1, 0} + aligned, true, true, {0, 1, 1, 0, 2, 0, 1, 0}},
      {"tie_between", "moving_point_aabox", Numbers{3, 3, 0, -1, -1, 0} + aligned, false, true, {0, 1, 1, 0, 2, r2, r2, 0}},
      {"degenerate_flat", "moving_point_aabox", {0, 0, 2, 0, 0, -1, -1, -1, 0, 1, 1, 0}, true, true, {0, 0, 0, 0, 2, 0, 0, 1}},

      {"hit_face", "ray_aabox", Numbers{3, 0.5, 0, -2, 0, 0} + aligned, true, true, {0, 1, 0.5, 0}},
      {"hit_far_face", "ray_aabox", Numbers{3, 0.5, 0, -2, 0, 0} + aligned, false, true, {0, -1, 0.5, 0}},
      {"miss_beside", "ray_aabox", Numbers{3, 2, 0, -2, 0, 0} + aligned, true, false, {0}},
      {"miss_behind", "ray_aabox", Numbers{3, 0, 0, 2, 0, 0} + aligned, true, false, {0}},
      {"touch_edge", "ray_aabox", Numbers{3, 1, 0, -2, 0, 0} + aligned, true, true, {0, 1, 1, 0}},
      {"touch_leaving", "ray_aabox", Numbers{1, 0, 0, 2, 0, 0} + aligned, true, true, {1, 1, 0, 0}},
      {"inside_origin", "ray_aabox", Numbers{0.5, 0, 0, 2, 0, 0} + aligned, true, true, {1, 0.5, 0, 0}},
      {"inside_not_its_exit", "ray_aabox", Numbers{0.5, 0, 0, 2, 0, 0} + aligned, false, true, {1, 1, 0, 0}},
      {"degenerate_flat", "ray_aabox", {0, 0, 2, 0, 0, -1, -1, -1, 0, 1, 1, 0}, true, true, {0, 0, 0, 0}},
      {"degenerate_point", "ray_aabox", {0, 0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 0}, true, true, {0, 0, 0, 0}},
  };
}

std::vector<Hand> hands_of_moving_spheres() {
  return {
      // Radius 1 from height 5: at height 1 after 4.
      {"hit_down", "moving_sphere_plane", Numbers{0, 0, 5, 1, 0, 0, -1} + ground, true, true, {4, 0, 0, 0, 0, 0, 1}},
      {"hit_as_a_point", "moving_sphere_plane", Numbers{0, 0, 5, 1, 0, 0, -1} + ground, false, true, {5, 0, 0, 0, 0, 0, 1}},
      {"miss_along", "moving_sphere_plane", Numbers{0, 0, 5, 1, 1, 0, 0} + ground, true, false, {inf}},
      {"touch_sliding", "moving_sphere_plane", Numbers{0, 0, 1, 1, 1, 0, 0} + ground, true, true, {0, 0, 0, 0, 0, 0, 1}},
      {"touch_from_behind", "moving_sphere_plane", Numbers{0, 0, -1, 1, 0, 0, -1} + ground, true, true, {0, 0, 0, 0, 0, 0, 1}},
      {"inside_both_sides", "moving_sphere_plane", Numbers{0, 0, 0.5, 1, 0, 0, -1} + ground, true, true, {0, 0, 0, 0, 0, 0, 1}},
      // A center behind the plane: the way back is right as well.
      {"tie_up", "moving_sphere_plane", Numbers{0, 0, -0.5, 1, 0, 0, -1} + ground, true, true, {0, 0, 0, 0, 0, 0, 1}},
      {"tie_down", "moving_sphere_plane", Numbers{0, 0, -0.5, 1, 0, 0, -1} + ground, true, true, {0, 0, 0, 0, 0, 0, -1}},
      {"gate_leaving", "moving_sphere_plane", Numbers{0, 0, 0.5, 1, 0, 0, 1} + ground, true, false, {inf}},
      {"gate_wholly_behind", "moving_sphere_plane", Numbers{0, 0, -2, 1, 0, 0, -1} + ground, true, false, {inf}},
      {"degenerate_point", "moving_sphere_plane", Numbers{0, 0, 5, 0, 0, 0, -1} + ground, true, true, {5, 0, 0, 0, 0, 0, 1}},

      // Onto the face as above, with weights; onto the edge y = 0 and the vertex (4, 0, 0) within the plane.
      {"hit_face", "moving_sphere_triangle", Numbers{1, 1, 5, 1, 0, 0, -1} + triangle, true, true, {4, 1, 1, 0, 0, 0, 1, 0.5, 0.25, 0.25}},
      {"hit_face_weights", "moving_sphere_triangle", Numbers{1, 1, 5, 1, 0, 0, -1} + triangle, false, true, {4, 1, 1, 0, 0, 0, 1, 0.25, 0.5, 0.25}},
      {"hit_edge", "moving_sphere_triangle", Numbers{1, -3, 0, 1, 0, 1, 0} + triangle, true, true, {2, 1, 0, 0, 0, -1, 0, 0.75, 0.25, 0}},
      {"hit_vertex", "moving_sphere_triangle", Numbers{7, 0, 0, 1, -1, 0, 0} + triangle, true, true, {2, 4, 0, 0, 1, 0, 0, 0, 1, 0}},
      {"miss_beside", "moving_sphere_triangle", Numbers{6, 6, 5, 1, 0, 0, -1} + triangle, true, false, {inf}},
      // Down at distance 1 from the edge: at its height after 5.
      {"touch_edge_in_passing", "moving_sphere_triangle", Numbers{1, -1, 5, 1, 0, 0, -1} + triangle, true, true, {5, 1, 0, 0, 0, -1, 0, 0.75, 0.25, 0}},
      {"touch_sliding", "moving_sphere_triangle", Numbers{1, 1, 1, 1, 1, 0, 0} + triangle, true, true, {0, 1, 1, 0, 0, 0, 1}},
      {"inside_overlap", "moving_sphere_triangle", Numbers{1, 1, 0.5, 1, 0, 0, -1} + triangle, true, true, {0, 1, 1, 0, 0, 0, 1}},
      {"inside_from_behind", "moving_sphere_triangle", Numbers{1, 1, -0.5, 1, 0, 0, -1} + triangle, true, true, {0, 1, 1, 0, 0, 0, -1}},
      {"tie_up", "moving_sphere_triangle", Numbers{1, 1, 0, 1, 0, 0, -1} + triangle, true, true, {0, 1, 1, 0, 0, 0, 1}},
      {"tie_down", "moving_sphere_triangle", Numbers{1, 1, 0, 1, 1, 0, 0} + triangle, true, true, {0, 1, 1, 0, 0, 0, -1}},
      // The center on the triangle: of its two sides the one that is met.
      {"tie_side_that_is_left", "moving_sphere_triangle", Numbers{1, 1, 0, 1, 0, 0, -1} + triangle, false, true, {0, 1, 1, 0, 0, 0, -1}},
      {"tie_aside", "moving_sphere_triangle", Numbers{1, 1, 0, 1, 0, 0, -1} + triangle, false, true, {0, 1, 1, 0, 1, 0, 0}},
      {"gate_from_behind", "moving_sphere_triangle", Numbers{1, 1, -5, 1, 0, 0, 1} + triangle, true, false, {inf}},
      {"gate_wholly_behind", "moving_sphere_triangle", Numbers{1, -3, -2, 1, 0, 1, 0} + triangle, true, false, {inf}},
      // Without area there is no gate: from above and from below.
      {"degenerate_segment", "moving_sphere_triangle", Numbers{1, 0, 5, 1, 0, 0, -1} + flat_triangle, true, true, {4, 1, 0, 0, 0, 0, 1}},
      {"degenerate_from_below", "moving_sphere_triangle", Numbers{1, 0, -5, 1, 0, 0, 1} + flat_triangle, true, true, {4, 1, 0, 0, 0, 0, -1}},
      {"degenerate_point", "moving_sphere_triangle", {4, 0, 0, 1, -1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, true, true, {3, 0, 0, 0, 1, 0, 0}},

      {"hit_first_half", "moving_sphere_rectangle", Numbers{3, 1, 5, 1, 0, 0, -1} + rectangle, true, true, {4, 3, 1, 0, 0, 0, 1}},
      {"hit_second_half", "moving_sphere_rectangle", Numbers{1, 1.5, 5, 1, 0, 0, -1} + rectangle, true, true, {4, 1, 1.5, 0, 0, 0, 1}},
      {"hit_denied", "moving_sphere_rectangle", Numbers{1, 1.5, 5, 1, 0, 0, -1} + rectangle, false, false, {inf}},
      {"miss_beside", "moving_sphere_rectangle", Numbers{9, 1, 5, 1, 0, 0, -1} + rectangle, true, false, {inf}},
      {"touch_edge_in_passing", "moving_sphere_rectangle", Numbers{3, -1, 5, 1, 0, 0, -1} + rectangle, true, true, {5, 3, 0, 0, 0, -1, 0}},
      {"touch_diagonal", "moving_sphere_rectangle", Numbers{2, 1, 5, 1, 0, 0, -1} + rectangle, true, true, {4, 2, 1, 0, 0, 0, 1}},
      {"inside_overlap", "moving_sphere_rectangle", Numbers{3, 1, 0.5, 1, 0, 0, -1} + rectangle, true, true, {0, 3, 1, 0, 0, 0, 1}},
      {"tie_up", "moving_sphere_rectangle", Numbers{3, 1, 0, 1, 0, 0, -1} + rectangle, true, true, {0, 3, 1, 0, 0, 0, 1}},
      {"tie_down", "moving_sphere_rectangle", Numbers{3, 1, 0, 1, 1, 0, 0} + rectangle, true, true, {0, 3, 1, 0, 0, 0, -1}},
      {"tie_side_that_is_left", "moving_sphere_rectangle", Numbers{3, 1, 0, 1, 0, 0, -1} + rectangle, false, true, {0, 3, 1, 0, 0, 0, -1}},
      {"gate_from_behind", "moving_sphere_rectangle", Numbers{3, 1, -5, 1, 0, 0, 1} + rectangle, true, false, {inf}},
      {"degenerate_segment", "moving_sphere_rectangle", Numbers{3, 0, 5, 1, 0, 0, -1} + flat_rectangle, true, true, {4, 3, 0, 0, 0, 0, 1}},

      // Radii 1 and 2: centers 3 apart.
      {"hit_head_on", "moving_sphere_sphere", {6, 0, 0, 1, -1, 0, 0, 0, 0, 0, 2}, true, true, {3, 2, 0, 0, 1, 0, 0}},
      {"hit_as_a_point", "moving_sphere_sphere", {6, 0, 0, 1, -1, 0, 0, 0, 0, 0, 2}, false, true, {4, 2, 0, 0, 1, 0, 0}},
      {"miss_beside", "moving_sphere_sphere", {6, 4, 0, 1, -1, 0, 0, 0, 0, 0, 2}, true, false, {inf}},
      {"touch_tangent", "moving_sphere_sphere", {6, 3, 0, 1, -1, 0, 0, 0, 0, 0, 2}, true, true, {6, 0, 2, 0, 0, 1, 0}},
      {"touch_sliding", "moving_sphere_sphere", {3, 0, 0, 1, 0, 1, 0, 0, 0, 0, 2}, true, true, {0, 2, 0, 0, 1, 0, 0}},
      {"touch_leaving", "moving_sphere_sphere", {3, 0, 0, 1, 1, 0, 0, 0, 0, 0, 2}, true, false, {inf}},
      {"inside_leaving", "moving_sphere_sphere", {2, 0, 0, 1, 1, 0, 0, 0, 0, 0, 2}, true, true, {0, 2, 0, 0, 1, 0, 0}},
      // The same center: any place of the surface, with its own normal.
      {"tie_anywhere", "moving_sphere_sphere", {0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 2}, true, true, {0, 0, 0, 2, 0, 0, 1}},
      {"tie_not_its_normal", "moving_sphere_sphere", {0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 2}, false, true, {0, 0, 0, 2, 0, 1, 0}},
      {"degenerate_points", "moving_sphere_sphere", {5, 0, 0, 0, -1, 0, 0, 0, 0, 0, 0}, true, true, {5, 0, 0, 0, 0, 1, 0}},
      {"degenerate_point_inside", "moving_sphere_sphere", {0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 2}, true, false, {inf}},

      {"miss_beside", "moving_sphere_box", Numbers{5, 3, 0, 1, -1, 0, 0} + cube, true, false, {inf}},

      // Radii 1 and 1 about the axis: 2 apart.
      {"hit_tube", "moving_sphere_capsule", Numbers{2, 0, 5, 1, 0, 0, -1} + tube, true, true, {3, 2, 0, 1, 0, 0, 1}},
      {"hit_as_a_point", "moving_sphere_capsule", Numbers{2, 0, 5, 1, 0, 0, -1} + tube, false, true, {4, 2, 0, 1, 0, 0, 1}},
      {"hit_end", "moving_sphere_capsule", Numbers{8, 0, 0, 1, -1, 0, 0} + tube, true, true, {2, 5, 0, 0, 1, 0, 0}},
      {"miss_beside", "moving_sphere_capsule", Numbers{2, 3, 5, 1, 0, 0, -1} + tube, true, false, {inf}},
      {"touch_tangent", "moving_sphere_capsule", Numbers{2, 2, 5, 1, 0, 0, -1} + tube, true, true, {5, 2, 1, 0, 0, 1, 0}},
      {"touch_leaving", "moving_sphere_capsule", Numbers{2, 0, 2, 1, 0, 0, 1} + tube, true, false, {inf}},
      {"inside_leaving", "moving_sphere_capsule", Numbers{2, 0, 1.5, 1, 0, 0, 1} + tube, true, true, {0, 2, 0, 1, 0, 0, 1}},
      // The center on the axis: any way out at a right angle to it.
      {"tie_up", "moving_sphere_capsule", Numbers{2, 0, 0, 1, 0, 0, 1} + tube, true, true, {0, 2, 0, 1, 0, 0, 1}},
      {"tie_aside", "moving_sphere_capsule", Numbers{2, 0, 0, 1, 0, 0, 1} + tube, true, true, {0, 2, 1, 0, 0, 1, 0}},
      {"tie_along", "moving_sphere_capsule", Numbers{2, 0, 0, 1, 0, 0, 1} + tube, false, true, {0, 3, 0, 0, 1, 0, 0}},
      {"degenerate_segment", "moving_sphere_capsule", {2, 0, 5, 1, 0, 0, -1, 0, 0, 0, 4, 0, 0, 0}, true, true, {4, 2, 0, 0, 0, 0, 1}},
      {"degenerate_point", "moving_sphere_capsule", {4, 0, 0, 1, -1, 0, 0, 0, 0, 0, 0, 0, 0, 0}, true, true, {3, 0, 0, 0, 1, 0, 0}},

      // Sphere, velocity, box, limit, forever. From x = 5 at speed 1 it touches the face x = 1 at time 3.
      {"hit_in_time", "moving_sphere_passes_box", Numbers{5, 0, 0, 1, -1, 0, 0} + cube + Numbers{4, 0}, true, true, {}},
      {"hit_denied", "moving_sphere_passes_box", Numbers{5, 0, 0, 1, -1, 0, 0} + cube + Numbers{4, 0}, false, false, {}},
      {"miss_beside", "moving_sphere_passes_box", Numbers{5, 3, 0, 1, -1, 0, 0} + cube + Numbers{0, 1}, true, false, {}},
      {"touch_at_the_limit", "moving_sphere_passes_box", Numbers{5, 0, 0, 1, -1, 0, 0} + cube + Numbers{3, 0}, true, true, {}},
      {"touch_in_passing", "moving_sphere_passes_box", Numbers{5, 2, 0, 1, -1, 0, 0} + cube + Numbers{0, 1}, true, true, {}},
      {"touch_leaving", "moving_sphere_passes_box", Numbers{2, 0, 0, 1, 1, 0, 0} + cube + Numbers{0, 0}, true, true, {}},
      {"inside_point_at_rest", "moving_sphere_passes_box", Numbers{0, 0, 0, 0, 0, 0, 0} + cube + Numbers{0, 0}, true, true, {}},
      {"gate_too_late", "moving_sphere_passes_box", Numbers{5, 0, 0, 1, -1, 0, 0} + cube + Numbers{2.5, 0}, true, false, {}},
      {"gate_forever", "moving_sphere_passes_box", Numbers{5, 0, 0, 1, -1, 0, 0} + cube + Numbers{0, 1}, true, true, {}},
      // A box that is a point at 0 is reached at time 4.
      {"degenerate_point", "moving_sphere_passes_box", Numbers{5, 0, 0, 1, -1, 0, 0} + point_box + Numbers{4, 0}, true, true, {}},
      {"degenerate_point_too_late", "moving_sphere_passes_box", Numbers{5, 0, 0, 1, -1, 0, 0} + point_box + Numbers{3.5, 0}, true, false, {}},
      // The same with a ball of radius 2 from x = 6: 3 apart at time 3.
      {"hit_in_time", "moving_sphere_passes_sphere", {6, 0, 0, 1, -1, 0, 0, 0, 0, 0, 2, 4, 0}, true, true, {}},
      {"hit_denied", "moving_sphere_passes_sphere", {6, 0, 0, 1, -1, 0, 0, 0, 0, 0, 2, 4, 0}, false, false, {}},
      {"miss_beside", "moving_sphere_passes_sphere", {6, 4, 0, 1, -1, 0, 0, 0, 0, 0, 2, 0, 1}, true, false, {}},
      {"touch_at_the_limit", "moving_sphere_passes_sphere", {6, 0, 0, 1, -1, 0, 0, 0, 0, 0, 2, 3, 0}, true, true, {}},
      {"touch_in_passing", "moving_sphere_passes_sphere", {6, 3, 0, 1, -1, 0, 0, 0, 0, 0, 2, 0, 1}, true, true, {}},
      {"touch_leaving", "moving_sphere_passes_sphere", {3, 0, 0, 1, 1, 0, 0, 0, 0, 0, 2, 0, 0}, true, true, {}},
      {"inside_at_rest", "moving_sphere_passes_sphere", {1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 2, 0, 0}, true, true, {}},
      {"gate_too_late", "moving_sphere_passes_sphere", {6, 0, 0, 1, -1, 0, 0, 0, 0, 0, 2, 2.5, 0}, true, false, {}},
      {"gate_forever", "moving_sphere_passes_sphere", {6, 0, 0, 1, -1, 0, 0, 0, 0, 0, 2, 0, 1}, true, true, {}},
      {"degenerate_points", "moving_sphere_passes_sphere", {6, 0, 0, 0, -1, 0, 0, 0, 0, 0, 0, 6, 0}, true, true, {}},
      {"degenerate_points_too_late", "moving_sphere_passes_sphere", {6, 0, 0, 0, -1, 0, 0, 0, 0, 0, 0, 5.5, 0}, true, false, {}},
  };
}

std::vector<Hand> hands_of_overlaps() {
  return {
      {"hit_overlap", "sphere_sphere_overlap", {0, 0, 0, 2, 3, 0, 0, 2}, true, true, {}},
      {"hit_denied", "sphere_sphere_overlap", {0, 0, 0, 2, 3, 0, 0, 2}, false, false, {}},
      {"miss_apart", "sphere_sphere_overlap", {0, 0, 0, 2, 5, 0, 0, 2}, true, false, {}},
      {"touch_oblique", "sphere_sphere_overlap", {0, 0, 0, 3, 3, 4, 0, 2}, true, true, {}},
      {"inside_same_center", "sphere_sphere_overlap", {1, 1, 1, 3, 1, 1, 1, 2}, true, true, {}},
      {"degenerate_same_point", "sphere_sphere_overlap", {1, 1, 1, 0, 1, 1, 1, 0}, true, true, {}},
      {"degenerate_points", "sphere_sphere_overlap", {0, 0, 0, 0, 0, 1, 0, 0}, true, false, {}},

      // From the edge (1, 1, *) the center (4, 5) is 5 away.
      {"hit_face", "sphere_box_overlap", Numbers{2.5, 0, 0, 2} + cube, true, true, {}},
      {"hit_denied", "sphere_box_overlap", Numbers{2.5, 0, 0, 2} + cube, false, false, {}},
      {"miss_edge", "sphere_box_overlap", Numbers{4, 5, 0, 4} + cube, true, false, {}},
      {"touch_edge", "sphere_box_overlap", Numbers{4, 5, 0, 5} + cube, true, true, {}},
      {"inside_point", "sphere_box_overlap", Numbers{0, 0, 0, 0} + cube, true, true, {}},
      {"degenerate_box_touched", "sphere_box_overlap", Numbers{3, 4, 0, 5} + point_box, true, true, {}},
      {"degenerate_box_missed", "sphere_box_overlap", Numbers{3, 4, 0, 4} + point_box, true, false, {}},

      {"hit_overlap", "box_box_overlap", cube + cube_at(1.5, 0, 0) + Numbers{-1}, true, true, {}},
      {"inside_small", "box_box_overlap", cube + Numbers{0.5, 0, 0, 0.25, 0.25, 0.25, 0, 0, 1, 2} + Numbers{-1}, true, true, {}},
      // Apart along x and y: axis 0, 1 of box 1, 3, 4 of box 2 and all cross products that are x or y, not z.
      {"tie_axis_x", "box_box_overlap", cube + cube_at(5, 5, 0) + Numbers{-1}, true, false, {0}},
      {"tie_axis_y", "box_box_overlap", cube + cube_at(5, 5, 0) + Numbers{-1}, true, false, {4}},
      {"tie_axis_z", "box_box_overlap", cube + cube_at(5, 5, 0) + Numbers{-1}, false, false, {2}},
      // Flat boxes half a unit above each other.
      {"degenerate_flat", "box_box_overlap", flat_box + Numbers{0, 0, 0.5, 1, 1, 0, 0, 0, 0, 1} + Numbers{-1}, true, false, {2}},
      {"degenerate_same_point", "box_box_overlap", point_box + point_box + Numbers{-1}, true, true, {}},

      {"hit_face", "sphere_triangle_overlap", Numbers{1, 1, 1, 2} + triangle, true, true, {}},
      {"hit_from_behind", "sphere_triangle_overlap", Numbers{1, 1, -1, 2} + triangle, true, true, {}},
      {"hit_denied", "sphere_triangle_overlap", Numbers{1, 1, -1, 2} + triangle, false, false, {}},
      {"miss_above", "sphere_triangle_overlap", Numbers{1, 1, 3, 2} + triangle, true, false, {}},
      {"touch_face", "sphere_triangle_overlap", Numbers{1, 1, 3, 3} + triangle, true, true, {}},
      // (7, 0, 4) - (4, 0, 0) = (3, 0, 4).
      {"touch_vertex", "sphere_triangle_overlap", Numbers{7, 0, 4, 5} + triangle, true, true, {}},
      {"inside_point", "sphere_triangle_overlap", Numbers{1, 1, 0, 0} + triangle, true, true, {}},
      {"degenerate_segment_touched", "sphere_triangle_overlap", Numbers{1, 3, 0, 3} + flat_triangle, true, true, {}},
      {"degenerate_segment_missed", "sphere_triangle_overlap", Numbers{1, 3, 0, 2.5} + flat_triangle, true, false, {}},

      // The box from 0 to 2. The plane x + y + z = 6 touches its corner (2, 2, 2), the one with 7 passes by.
      {"hit_through", "aabox_triangle_overlap", {0, 0, 0, 2, 2, 2, -9, -9, 1, 9, -9, 1, 0, 20, 1}, true, true, {}},
      {"hit_denied", "aabox_triangle_overlap", {0, 0, 0, 2, 2, 2, -9, -9, 1, 9, -9, 1, 0, 20, 1}, false, false, {}},
      {"miss_coordinate", "aabox_triangle_overlap", {0, 0, 0, 2, 2, 2, 3, 0, 0, 4, 0, 0, 3, 2, 2}, true, false, {}},
      {"miss_plane", "aabox_triangle_overlap", {0, 0, 0, 2, 2, 2, 7, 0, 0, 0, 7, 0, 0, 0, 7}, true, false, {}},
      {"touch_corner", "aabox_triangle_overlap", {0, 0, 0, 2, 2, 2, 6, 0, 0, 0, 6, 0, 0, 0, 6}, true, true, {}},
      {"touch_face_with_vertex", "aabox_triangle_overlap", {0, 0, 0, 2, 2, 2, 2, 1, 1, 4, 0, 0, 4, 2, 2}, true, true, {}},
      {"inside_whole", "aabox_triangle_overlap", {0, 0, 0, 2, 2, 2, 1, 1, 1, 1.5, 1, 1, 1, 1.5, 1}, true, true, {}},
      // Segments in z = 0: x + y = 3 cuts the square, x + y = 5 does not; a point inside.
      {"degenerate_segment", "aabox_triangle_overlap", {0, 0, 0, 2, 2, 2, 3, 0, 0, 0, 3, 0, 0, 3, 0}, true, true, {}},
      {"degenerate_segment_missed", "aabox_triangle_overlap", {0, 0, 0, 2, 2, 2, 5, 0, 0, 0, 5, 0, 0, 5, 0}, true, false, {}},
      {"degenerate_point", "aabox_triangle_overlap", {0, 0, 0, 2, 2, 2, 1, 1, 1, 1, 1, 1, 1, 1, 1}, true, true, {}},
  };
}

/// The corners of a cube in the order of their bits, each a contact at that height or, from the fifth on, none.
Numbers lower_corners(double z) { return {1, -1, -1, z, 1, 1, -1, z, 1, -1, 1, z, 1, 1, 1, z, 0, 0, 0, 0}; }

std::vector<Hand> hands_of_depths() {
  return {
      // 2 + 2 - 3 = 1; contact: the first one's (2, 0, 0).
      {"hit_overlap", "sphere_sphere_penetration", {0, 0, 0, 2, 3, 0, 0, 2}, true, true, {1, 1, 0, 0, 2, 0, 0}},
      {"hit_turned_round", "sphere_sphere_penetration", {0, 0, 0, 2, 3, 0, 0, 2}, false, true, {1, -1, 0, 0, 2, 0, 0}},
      {"miss_apart", "sphere_sphere_penetration", {0, 0, 0, 2, 5, 0, 0, 2}, true, false, {-1}},
      {"touch_oblique", "sphere_sphere_penetration", {0, 0, 0, 2, 3, 4, 0, 3}, true, true, {0, 0.6, 0.8, 0, 1.2, 1.6, 0}},
      // Within: 4 + 1 - 1 = 4, and the deepest point lies beyond the small one.
      {"inside_large", "sphere_sphere_penetration", {0, 0, 0, 4, 1, 0, 0, 1}, true, true, {4, 1, 0, 0, 4, 0, 0}},
      {"tie_same_center", "sphere_sphere_penetration", {0, 0, 0, 2, 0, 0, 0, 2}, true, true, {4, 0, 0.6, 0.8, 0, 1.2, 1.6}},
      {"tie_not_its_contact", "sphere_sphere_penetration", {0, 0, 0, 2, 0, 0, 0, 2}, false, true, {4, 0, 1, 0, 0, 0, 2}},
      {"degenerate_same_point", "sphere_sphere_penetration", {0, 0, 0, 0, 0, 0, 0, 0}, true, true, {0, 0, 1, 0, 0, 0, 0}},

      {"hit_overlap", "sphere_plane_penetration", Numbers{0, 0, 0.5, 1} + ground, true, true, {0.5, 0, 0, 1, 0, 0, -0.5}},
      {"hit_too_deep", "sphere_plane_penetration", Numbers{0, 0, 0.5, 1} + ground, false, true, {1.5, 0, 0, 1, 0, 0, -0.5}},
      // z = 1 by a normal of length 2.
      {"hit_long_normal", "sphere_plane_penetration", {0, 0, 1.5, 1, 0, 0, 2, -2}, true, true, {0.5, 0, 0, 1, 0, 0, 0.5}},
      {"miss_above", "sphere_plane_penetration", Numbers{0, 0, 3, 1} + ground, true, false, {-2}},
      {"touch_ground", "sphere_plane_penetration", Numbers{0, 0, 1, 1} + ground, true, true, {0, 0, 0, 1, 0, 0, 0}},
      {"inside_wholly_behind", "sphere_plane_penetration", Numbers{0, 0, -2, 1} + ground, true, true, {3, 0, 0, 1, 0, 0, -3}},
      {"degenerate_point", "sphere_plane_penetration", Numbers{0, 0, 0, 0} + ground, true, true, {0, 0, 0, 1, 0, 0, 0}},

      {"hit_overlap", "box_plane_penetration", cube_at(0, 0, 0.5) + ground, true, true, Numbers{0.5, 0, 0, 1} + lower_corners(-0.5)},
      {"hit_corner_flag", "box_plane_penetration", cube_at(0, 0, 0.5) + ground, false, true, {0.5, 0, 0, 1, 0, 0, 0, 0}},
      {"miss_above", "box_plane_penetration", cube_at(0, 0, 3) + ground, true, false, {-2}},
      {"touch_ground", "box_plane_penetration", cube_at(0, 0, 1) + ground, true, true, Numbers{0, 0, 0, 1} + lower_corners(0)},
      // Wholly behind: its lower corners at -4, its upper ones contacts as well.
      {"inside_wholly_behind", "box_plane_penetration", cube_at(0, 0, -3) + ground, true, true, {4, 0, 0, 1, 1, -1, -1, -4, 1, 1, -1, -4, 1, -1, 1, -4, 1, 1, 1, -4, 1, -1, -1, -2}},
      {"degenerate_point", "box_plane_penetration", point_box + ground, true, true, {0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0}},

      {"degenerate_box", "sphere_box_penetration", Numbers{3, 0, 0, 4} + point_box, true, true, {1, -1, 0, 0, 0, 0, 0}},

      // Half a unit of overlap along x; box 2's vertices at x = 1/2, box 1's face at 1: half way.
      {"hit_face", "box_box_penetration", cube + cube_at(1.5, 0, 0) + Numbers{-1}, true, true, {0.5, 0, 1, 0, 0, 0.75, 1, 1}},
      {"hit_other_vertex", "box_box_penetration", cube + cube_at(1.5, 0, 0) + Numbers{-1}, true, true, {0.5, 0, 1, 0, 0, 0.75, -1, 1}},
      {"hit_middle_of_the_patch", "box_box_penetration", cube + cube_at(1.5, 0, 0) + Numbers{-1}, true, true, {0.5, 0, 1, 0, 0, 0.75, 0, 0}},
      {"hit_off_the_patch", "box_box_penetration", cube + cube_at(1.5, 0, 0) + Numbers{-1}, false, true, {0.5, 0, 1, 0, 0, 0.75, 1.5, 0}},
      {"miss_apart", "box_box_penetration", cube + cube_at(5, 0, 0) + Numbers{-1}, true, false, {-3, 0}},
      {"miss_by_another_axis", "box_box_penetration", cube + cube_at(5, 0, 0) + Numbers{-1}, false, false, {-3, 1}},
      {"touch_face", "box_box_penetration", cube + cube_at(2, 0, 0) + Numbers{-1}, true, true, {0, 0, 1, 0, 0, 1, 1, 1}},
      // A quarter's half extent at x = 1/2: 1 + 1/4 - 1/2 = 3/4, its vertices at 1/4 and the face at 1.
      {"inside_small", "box_box_penetration", cube + Numbers{0.5, 0, 0, 0.25, 0.25, 0.25, 0, 0, 0, 1, -1}, true, true, {0.75, 0, 1, 0, 0, 0.625, 0.25, 0.25}},
      // The same cube twice: every axis overlaps by 2, either way round.
      {"tie_axis_and_side", "box_box_penetration", cube + cube + Numbers{-1}, true, true, {2, 1, 0, -1, 0, 1, 0, 1}},
      {"tie_not_its_normal", "box_box_penetration", cube + cube + Numbers{-1}, false, true, {2, 1, 1, 0, 0, 1, 0, 1}},
      {"degenerate_same_point", "box_box_penetration", point_box + point_box + Numbers{-1}, true, true, {0, 0, 1, 0, 0, 0, 0, 0}},
  };
}

std::vector<Hand> hands_of_boxes_and_responses() {
  // About z by cosine 3/5 and sine 4/5: its axes are (3, 4, 0) / 5, (-4, 3, 0) / 5 and z.
  const Numbers turned_away{3, 4, 5, 1, 1, 1, 0, 0, 1, 2};
  // Half a turn about (1, 2, 2) / 3: 2 u u - 1 has the rows (-7, 4, 4) / 9, (4, -1, 8) / 9 and (4, 8, -1) / 9.
  const Numbers half_turn{0, 0, 0, 1, 1, 1, 1, 2, 2, 0};
  const Numbers info{1, 2, 3, 1, 1, 1, 3, 4, 5, 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1, 0.6, 0.8, 0, 0.8, 0.6, 0, 0, 0, 1};
  return {
      // (3, 4, 5) along box 2's axes: (9 + 16) / 5, (-12 + 12) / 5, 5.
      {"hit_turned", "box_box_info", Numbers{0, 0, 0, 1, 2, 3, 0, 0, 0, 1} + turned_away, true, true, info + Numbers{3, 4, 5, 5, 0, 5}},
      {"hit_transposed", "box_box_info", Numbers{0, 0, 0, 1, 2, 3, 0, 0, 0, 1} + turned_away, false, true, info + Numbers{3, 4, 5, -1.4, 4.8, 5}},
      {"degenerate_points", "box_box_info", point_box + Numbers{1, 0, 0, 0, 0, 0, 0, 0, 0, 1}, true, true, {0, 0, 0, 0, 0, 0, 1, 0, 0}},

      {"hit_apart", "box_box_projected_distance", cube + cube_at(5, 0, 0) + Numbers{0}, true, true, {3}},
      {"hit_apart_off", "box_box_projected_distance", cube + cube_at(5, 0, 0) + Numbers{0}, false, true, {4}},
      {"hit_overlap", "box_box_projected_distance", cube + cube_at(1.5, 0, 0) + Numbers{0}, true, true, {-0.5}},
      // A turned cube of half extent 5 reaches 7 along x: 12 - 1 - 7.
      {"hit_turned", "box_box_projected_distance", cube + Numbers{12, 0, 0, 5, 5, 5, 0, 0, 1, 2, 0}, true, true, {4}},
      {"touch_face", "box_box_projected_distance", cube + cube_at(2, 0, 0) + Numbers{3}, true, true, {0}},
      // z x z is no axis: everything along it is 0.
      {"degenerate_axis", "box_box_projected_distance", cube + cube_at(5, 0, 0) + Numbers{14}, true, true, {0}},

      // Axis 3: box 2's first. 6: x times it = (0, 0, 4) / 5. 7: x times the second. 9: y times the first = (0, 0, -3) / 5.
      {"hit_of_box_1", "box_box_separating_axis", cube + turned_away + Numbers{1}, true, true, {0, 1, 0}},
      {"hit_of_box_2", "box_box_separating_axis", cube + turned_away + Numbers{3}, true, true, {0.6, 0.8, 0}},
      {"hit_transposed", "box_box_separating_axis", cube + turned_away + Numbers{3}, false, true, {0.6, -0.8, 0}},
      {"hit_x_first", "box_box_separating_axis", cube + turned_away + Numbers{6}, true, true, {0, 0, 0.8}},
      {"hit_x_second", "box_box_separating_axis", cube + turned_away + Numbers{7}, true, true, {0, 0, 0.6}},
      {"hit_y_first", "box_box_separating_axis", cube + turned_away + Numbers{9}, true, true, {0, 0, -0.6}},
      {"hit_y_first_opposite", "box_box_separating_axis", cube + turned_away + Numbers{9}, false, true, {0, 0, 0.6}},
      // z times the first = (-4, 3, 0) / 5, its own length, not divided by.
      {"hit_z_first", "box_box_separating_axis", cube + turned_away + Numbers{12}, true, true, {-0.8, 0.6, 0}},
      {"degenerate_parallel", "box_box_separating_axis", cube + turned_away + Numbers{14}, true, true, {0, 0, 0}},

      // Only z is parallel to z; 3/5 and 4/5 are not 1, but 4/5 is more than 3/4, in the row of x.
      {"hit_z", "box_box_parallel_axis", cube + turned_away + Numbers{0}, true, true, {2, 2}},
      {"hit_generous", "box_box_parallel_axis", cube + turned_away + Numbers{0.25}, true, true, {0, 1}},
      // 8/9 is the largest: not 15/16, but 7/8.
      {"miss_none", "box_box_parallel_axis", cube + half_turn + Numbers{0.0625}, true, false, {}},
      {"hit_third_in_row", "box_box_parallel_axis", cube + half_turn + Numbers{0.125}, true, true, {1, 2}},
      // A quarter turn: x against x is 0, which is exactly 1 - 1.
      {"touch_zero", "box_box_parallel_axis", cube + Numbers{0, 0, 0, 1, 1, 1, 0, 0, 1, 1, 1}, true, true, {0, 0}},
      // All three pairs: the first in the order of rows.
      {"tie_first_row", "box_box_parallel_axis", cube + cube + Numbers{0}, true, true, {0, 0}},
      {"tie_later_row", "box_box_parallel_axis", cube + cube + Numbers{0}, false, true, {1, 1}},

      // Half diagonals |(1, 2, 2)| = |(2, 1, 2)| = 3.
      {"hit_near", "box_box_conservative", {0, 0, 0, 1, 2, 2, 0, 0, 0, 1, 5, 0, 0, 2, 1, 2, 0, 0, 0, 1}, true, true, {}},
      {"hit_denied", "box_box_conservative", {0, 0, 0, 1, 2, 2, 0, 0, 0, 1, 5, 0, 0, 2, 1, 2, 0, 0, 0, 1}, false, false, {}},
      {"miss_far", "box_box_conservative", {0, 0, 0, 1, 2, 2, 0, 0, 0, 1, 7, 0, 0, 2, 1, 2, 0, 0, 0, 1}, true, false, {}},
      {"touch_six", "box_box_conservative", {0, 0, 0, 1, 2, 2, 0, 0, 0, 1, 6, 0, 0, 2, 1, 2, 0, 0, 0, 1}, true, true, {}},
      {"degenerate_same_point", "box_box_conservative", point_box + point_box, true, true, {}},
      {"degenerate_points", "box_box_conservative", point_box + Numbers{1, 0, 0, 0, 0, 0, 0, 0, 0, 1}, true, false, {}},

      // At a right angle to the way to the center nothing is turned round.
      {"touch_grazing", "bounce_direction", {0, 0, 1, 1, 3, 4, 0, 0, 0, 0, 0, 0, 0, 1}, true, true, {0.6, 0.8, 0}},

      // Sphere, velocity, time, location. At time 1/2 the center is above the location: what goes down is taken away.
      {"hit_along_ground", "slide_direction", {0, 0, 3, 1, 3, 0, -4, 0.5, 1.5, 0, 0}, true, true, {0.6, 0, 0}},
      {"hit_made_unit", "slide_direction", {0, 0, 3, 1, 3, 0, -4, 0.5, 1.5, 0, 0}, false, true, {1, 0, 0}},
      {"hit_head_on", "slide_direction", {0, 0, 3, 1, 0, 0, -4, 0.5, 0, 0, 0}, true, true, {0, 0, 0}},
      {"touch_grazing", "slide_direction", {0, 0, 1, 1, 3, 4, 0, 0, 0, 0, 0}, true, true, {0.6, 0.8, 0}},
      // The center is at the location: there is nothing to slide along.
      {"gate_at_the_location", "slide_direction", {0, 0, 0, 1, 3, 0, 4, 1, 3, 0, 4}, true, true, {0.6, 0, 0.8}},
      {"degenerate_at_rest", "slide_direction", {0, 0, 3, 1, 0, 0, 0, 1, 0, 0, 0}, true, true, {0, 0, 0}},
  };
}

// clang-format on

std::vector<Hand> all_hands() {
  std::vector<Hand> all = hands();
  for (const auto& more : {hands_of_points(), hands_of_moving_points(), hands_of_moving_spheres(), hands_of_overlaps(),
                           hands_of_depths(), hands_of_boxes_and_responses()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

/// What each query has: it has no start inside where nothing moves, no gate where nothing shuts it out.
const std::map<std::string, std::string> classes{
    {"closest_point_segment", "hit touch degenerate"},
    {"closest_point_segment_unit", "hit touch degenerate"},
    {"closest_point_triangle_perimeter", "hit touch tie degenerate"},
    {"closest_point_triangle_perimeter_edges", "hit touch tie degenerate"},
    {"closest_point_rectangle", "hit touch tie degenerate"},
    {"closest_point_rectangle_perimeter", "hit touch tie degenerate"},
    {"closest_points_lines", "hit touch tie degenerate"},
    {"point_in_triangle", "hit miss touch tie degenerate gate"},
    {"point_in_rectangle", "hit miss touch tie degenerate"},
    {"moving_point_plane", "hit miss touch gate"},
    {"moving_point_triangle", "hit miss touch degenerate gate"},
    {"moving_point_triangle_prepared", "hit miss touch degenerate gate"},
    {"moving_point_rectangle", "hit miss touch tie degenerate gate"},
    {"moving_point_sphere", "hit miss touch inside tie degenerate gate"},
    {"moving_point_capsule", "hit miss touch inside tie degenerate"},
    {"moving_point_box", "hit miss touch inside tie degenerate"},
    {"moving_point_aabox", "hit miss touch inside tie degenerate"},
    {"ray_aabox", "hit miss touch inside degenerate"},
    {"moving_sphere_plane", "hit miss touch inside tie degenerate gate"},
    {"moving_sphere_triangle", "hit miss touch inside tie degenerate gate"},
    {"moving_sphere_rectangle", "hit miss touch inside tie degenerate gate"},
    {"moving_sphere_sphere", "hit miss touch inside tie degenerate"},
    {"moving_sphere_box", "hit miss touch inside tie degenerate"},
    {"moving_sphere_capsule", "hit miss touch inside tie degenerate"},
    {"moving_sphere_passes_box", "hit miss touch inside degenerate gate"},
    {"moving_sphere_passes_sphere", "hit miss touch inside degenerate gate"},
    {"sphere_sphere_overlap", "hit miss touch inside degenerate"},
    {"sphere_box_overlap", "hit miss touch inside degenerate"},
    {"box_box_overlap", "hit miss touch inside tie degenerate gate"},
    {"sphere_triangle_overlap", "hit miss touch inside degenerate"},
    {"aabox_triangle_overlap", "hit miss touch inside degenerate"},
    {"sphere_sphere_penetration", "hit miss touch inside tie degenerate"},
    {"sphere_plane_penetration", "hit miss touch inside degenerate"},
    {"box_plane_penetration", "hit miss touch inside degenerate"},
    {"sphere_box_penetration", "hit miss touch inside tie degenerate"},
    {"box_box_penetration", "hit miss touch inside tie degenerate"},
    {"box_box_info", "hit degenerate"},
    {"box_box_projected_distance", "hit touch degenerate"},
    {"box_box_separating_axis", "hit degenerate"},
    {"box_box_parallel_axis", "hit miss touch tie"},
    {"box_box_conservative", "hit miss touch degenerate"},
    {"bounce_direction", "hit touch degenerate gate"},
    {"slide_direction", "hit touch degenerate gate"},
};

TEST(HandDerivedCases, EveryClassOfEveryQueryHasARightAnswerAndEveryQueryAWrongOne) {
  std::map<std::string, std::set<std::string>> right;
  std::set<std::string> wrong;
  for (const Hand& hand : all_hands()) {
    if (hand.right) right[hand.query].insert(hand.name.substr(0, hand.name.find('_')));
    if (!hand.right) wrong.insert(hand.query);
  }
  for (const Query& query : catalogue()) {
    const std::string name(query.name);
    ASSERT_TRUE(classes.contains(name)) << name << " has no row in the table";
    std::istringstream words(classes.at(name));
    const std::set<std::string> asked{std::istream_iterator<std::string>(words), {}};
    EXPECT_EQ(right[name], asked) << name;
    EXPECT_TRUE(wrong.contains(name)) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Derived, ByHand, testing::ValuesIn(all_hands()),
                         [](const auto& test) { return std::string(test.param.query) + "_" + test.param.name; });

}  // namespace
}  // namespace nearmiss
