/// An answer's place lies on a surface, and the judge detects if it does not: by hand for each query, and for generated
/// cases, whose right places must never be judged off the surface.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "corpus/generator/generator.hpp"
#include "corpus/storage/codec.hpp"
#include "oracles/exact/oracle.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

using Values = std::vector<double>;

constexpr double four_ulps = 0x1p-50;  ///< of numbers from 1 to 2

Values operator+(Values a, const Values& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const Values diagonal{0, 0, 0, 2, 2, 0};
const Values triangle{0, 0, 0, 4, 0, 0, 0, 4, 0};
const Values square{0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0};
const Values floor_plane{0, 0, 1, 0};
const Values capsule{0, 0, 0, 4, 0, 0, 1};
const Values x_axis{0, 0, 0, 4, 0, 0};
const Values raised{1, -4, 5, 1, 4, 5};  ///< a segment, across the x axis
const Values raised_triangle{0, 0, 5, 4, 0, 5, 0, 4, 5};
const Values down{0, 0, -1};  ///< a velocity
const Values cube{0, 0, 0, 1, 1, 1, 0, 0, 0, 1};
const Values raised_cube{0, 0, 5, 1, 1, 1, 0, 0, 0, 1};
const Values turned{0, 0, 0, 1, 1, 1, 0, 0, 1, 2};  ///< about z, with cosine 3/5 and sine 4/5
const Values aligned{-1, -1, -1, 1, 1, 1};
const Values x_and_raised_y{0, 0, 0, 1, 0, 0, 0, 0, 2, 0, 1, 0};
/// The lower corners of the cube around (0, 0, 1/2) lie behind z = 0; the test concerns the first one.
Values corners(double x, double y, double z) {
  Values all{0.5, 0, 0, 1,  //
             1,   x, y, z, 1, 1, -1, -0.5, 1, -1, 1, -0.5, 1, 1, 1, -0.5};
  all.resize(all.size() + 16, 0);
  return all;
}

/// Everything but one place is right, and that place lies on the surface or not.
struct Placed {
  std::string name;
  const char* query;
  Values inputs, answer;
  bool on_surface;
};
void PrintTo(const Placed& p, std::ostream* out) { *out << p.query << ' ' << p.name; }

const Placed placed[] = {
    // The foot of (2, 0, 0) is (1, 1, 0). The line extends beyond (2, 2, 0), the segment does not.
    {"elsewhere", "closest_point_segment", diagonal + Values{2, 0, 0}, {1.5, 1.5, 0}, true},
    {"beside", "closest_point_segment", diagonal + Values{2, 0, 0}, {1, 1, four_ulps}, false},
    {"beyond", "closest_point_segment", diagonal + Values{2, 0, 0}, {2.5, 2.5, 0}, false},
    {"elsewhere", "closest_point_segment_unit", diagonal + Values{2, 0, 0}, {1.5, 1.5, 0}, true},
    {"beyond", "closest_point_segment_unit", diagonal + Values{2, 0, 0}, {2.5, 2.5, 0}, false},
    // The nearest point to (1, -1, 0) is (1, 0, 0); the triangle's interior is not on its perimeter.
    {"other_edge", "closest_point_triangle_perimeter", triangle + Values{1, -1, 0}, {0, 1, 0}, true},
    {"inside", "closest_point_triangle_perimeter", triangle + Values{1, -1, 0}, {1, 1, 0}, false},
    {"other_place", "closest_point_triangle_perimeter_edges", triangle + Values{1, -1, 0}, {2, 0, 0, 0}, true},
    {"inside", "closest_point_triangle_perimeter_edges", triangle + Values{1, -1, 0}, {1, 1, 0, 0}, false},
    {"elsewhere", "closest_point_rectangle", square + Values{1, 1, 3}, {1, 3, 0}, true},
    {"above", "closest_point_rectangle", square + Values{1, 1, 3}, {1, 1, four_ulps}, false},
    {"other_edge", "closest_point_rectangle_perimeter", square + Values{1, -1, 0}, {0, 1, 0}, true},
    {"on_the_diagonal", "closest_point_rectangle_perimeter", square + Values{1, -1, 0}, {1, 1, 0}, false},
    // The nearest points are (0, 0, 0) and (0, 0, 2): each point has its own line.
    {"along_first", "closest_points_lines", x_and_raised_y, {1, 0, 0, 0, 0, 2}, true},
    {"off_first", "closest_points_lines", x_and_raised_y, {0, 1, 0, 0, 0, 2}, false},
    {"along_second", "closest_points_lines", x_and_raised_y, {0, 0, 0, 0, 1, 2}, true},
    {"off_second", "closest_points_lines", x_and_raised_y, {0, 0, 0, 1, 0, 2}, false},
    // What is nearest lies on the z axis, or above the place x = 1 of the x axis.
    {"elsewhere", "point_sphere_signed_distance", {0, 0, 5, 0, 0, 0, 1}, {4, 0, 0, -1, 0, 0, 5, 0, 1, 0}, true},
    {"inside", "point_sphere_signed_distance", {0, 0, 5, 0, 0, 0, 1}, {4, 0, 0, -1, 0, 0, 5, 0, 0, 0}, false},
    {"along", "point_segment_signed_distance", Values{1, 0, 5} + x_axis, {5, 0, 0, -1, 1, 0, 5, 2, 0, 0}, true},
    {"beside", "point_segment_signed_distance", Values{1, 0, 5} + x_axis, {5, 0, 0, -1, 1, 0, 5, 1, 1, 0}, false},
    {"along", "point_capsule_signed_distance", Values{1, 0, 5} + capsule, {4, 0, 0, -1, 1, 0, 5, 2, 0, 1}, true},
    {"inside", "point_capsule_signed_distance", Values{1, 0, 5} + capsule, {4, 0, 0, -1, 1, 0, 5, 1, 0, 0}, false},
    {"elsewhere", "sphere_sphere_signed_distance", {0, 0, 0, 1, 0, 0, 5, 1}, {3, 0, 0, 1, 0, 1, 0, 0, 0, 4}, true},
    {"inside", "sphere_sphere_signed_distance", {0, 0, 0, 1, 0, 0, 5, 1}, {3, 0, 0, 1, 0, 0, 0, 0, 0, 4}, false},
    {"along", "sphere_segment_signed_distance", Values{1, 0, 5, 1} + x_axis, {4, 0, 0, -1, 1, 0, 4, 2, 0, 0}, true},
    {"beside", "sphere_segment_signed_distance", Values{1, 0, 5, 1} + x_axis, {4, 0, 0, -1, 1, 0, 4, 1, 1, 0}, false},
    {"along", "sphere_capsule_signed_distance", Values{1, 0, 5, 1} + capsule, {3, 0, 0, -1, 1, 0, 4, 2, 0, 1}, true},
    {"inside", "sphere_capsule_signed_distance", Values{1, 0, 5, 1} + capsule, {3, 0, 0, -1, 1, 0, 4, 1, 0, 0}, false},
    {"along", "segment_segment_signed_distance", x_axis + raised, {5, 0, 0, 1, 2, 0, 0, 1, 0, 5}, true},
    {"beside", "segment_segment_signed_distance", x_axis + raised, {5, 0, 0, 1, 1, 1, 0, 1, 0, 5}, false},
    {"along", "segment_capsule_signed_distance", raised + capsule, {4, 0, 0, -1, 1, 0, 5, 2, 0, 1}, true},
    {"inside", "segment_capsule_signed_distance", raised + capsule, {4, 0, 0, -1, 1, 0, 5, 1, 0, 0}, false},
    {"along", "capsule_capsule_signed_distance", capsule + raised + Values{1}, {3, 0, 0, 1, 2, 0, 1, 1, 0, 4}, true},
    {"inside", "capsule_capsule_signed_distance", capsule + raised + Values{1}, {3, 0, 0, 1, 1, 0, 0, 1, 0, 4}, false},
    {"other_place",
     "point_triangle_signed_distance",
     Values{1, 1, 5} + triangle,
     {5, 0, 0, -1, 1, 1, 5, 2, 1, 0},
     true},
    {"above", "point_triangle_signed_distance", Values{1, 1, 5} + triangle, {5, 0, 0, -1, 1, 1, 5, 1, 1, 1}, false},
    {"other_place",
     "sphere_triangle_signed_distance",
     Values{1, 1, 5, 1} + triangle,
     {4, 0, 0, -1, 1, 1, 4, 2, 1, 0},
     true},
    {"inside",
     "sphere_triangle_signed_distance",
     Values{1, 1, 5, 1} + triangle,
     {4, 0, 0, -1, 1, 1, 5, 1, 1, 0},
     false},
    {"other_place", "segment_triangle_signed_distance", raised + triangle, {5, 0, 0, -1, 1, 1, 5, 2, 1, 0}, true},
    {"beside", "segment_triangle_signed_distance", raised + triangle, {5, 0, 0, -1, 0, 1, 5, 1, 1, 0}, false},
    {"other_place",
     "capsule_triangle_signed_distance",
     raised + Values{1} + triangle,
     {4, 0, 0, -1, 1, 1, 4, 2, 1, 0},
     true},
    {"inside",
     "capsule_triangle_signed_distance",
     raised + Values{1} + triangle,
     {4, 0, 0, -1, 1, 1, 5, 1, 1, 0},
     false},
    {"other_place",
     "triangle_triangle_signed_distance",
     triangle + Values{1, 1, 5, 1, 1, 9, 2, 1, 9},
     {5, 0, 0, 1, 1, 1, 0, 1, 1, 7},
     true},
    {"outside", "triangle_triangle_signed_distance", triangle + raised_triangle, {5, 0, 0, 1, 5, 5, 0, 1, 1, 5}, false},
    // 4 above the top of a cube.
    {"other_place", "point_box_signed_distance", Values{0, 0, 5} + cube, {4, 0, 0, -1, 0, 0, 5, 1, 0, 1}, true},
    {"inside", "point_box_signed_distance", Values{0, 0, 5} + cube, {4, 0, 0, -1, 0, 0, 5, 0, 0, 0}, false},
    {"other_place", "sphere_box_signed_distance", Values{0, 0, 5, 1} + cube, {3, 0, 0, -1, 0, 0, 4, 1, 0, 1}, true},
    {"inside", "sphere_box_signed_distance", Values{0, 0, 5, 1} + cube, {3, 0, 0, -1, 0, 0, 4, 0, 0, 0}, false},
    {"other_place", "segment_box_signed_distance", raised + cube, {4, 0, 0, -1, 1, 0, 5, 0, 0, 1}, true},
    {"beside", "segment_box_signed_distance", raised + cube, {4, 0, 0, -1, 0, 0, 5, 1, 0, 1}, false},
    {"other_place", "capsule_box_signed_distance", raised + Values{1} + cube, {3, 0, 0, -1, 1, 0, 4, 0, 0, 1}, true},
    {"inside", "capsule_box_signed_distance", raised + Values{1} + cube, {3, 0, 0, -1, 1, 0, 5, 1, 0, 1}, false},
    {"other_place", "triangle_box_signed_distance", raised_triangle + cube, {4, 0, 0, -1, 0, 0, 5, 1, 0, 0}, true},
    {"beside", "triangle_box_signed_distance", raised_triangle + cube, {4, 0, 0, -1, -1, 0, 5, 0, 0, 1}, false},
    {"other_place", "box_box_signed_distance", cube + raised_cube, {3, 0, 0, 1, 0, 0, 1, 1, 0, 5}, true},
    {"inside", "box_box_signed_distance", cube + raised_cube, {3, 0, 0, 1, 0, 0, 0, 0, 0, 4}, false},
    {"elsewhere",
     "point_halfspace_signed_distance",
     Values{1, 1, 5} + floor_plane,
     {5, 0, 0, -1, 1, 1, 5, 3, 1, 0},
     true},
    {"above", "point_halfspace_signed_distance", Values{1, 1, 5} + floor_plane, {5, 0, 0, -1, 1, 1, 5, 1, 1, 1}, false},
    {"elsewhere",
     "sphere_halfspace_signed_distance",
     Values{0, 0, 5, 1} + floor_plane,
     {4, 0, 0, -1, 0, 1, 5, 3, 0, 0},
     true},
    {"inside",
     "sphere_halfspace_signed_distance",
     Values{0, 0, 5, 1} + floor_plane,
     {4, 0, 0, -1, 0, 0, 5, 0, 0, 0},
     false},
    {"along", "segment_halfspace_signed_distance", raised + floor_plane, {5, 0, 0, -1, 1, 0, 5, 3, 0, 0}, true},
    {"beside", "segment_halfspace_signed_distance", raised + floor_plane, {5, 0, 0, -1, 0, 0, 5, 1, 0, 0}, false},
    {"along",
     "capsule_halfspace_signed_distance",
     raised + Values{1} + floor_plane,
     {4, 0, 0, -1, 1, 0, 4, 3, 0, 0},
     true},
    {"inside",
     "capsule_halfspace_signed_distance",
     raised + Values{1} + floor_plane,
     {4, 0, 0, -1, 1, 0, 5, 1, 0, 0},
     false},
    {"other_place",
     "triangle_halfspace_signed_distance",
     raised_triangle + floor_plane,
     {5, 0, 0, -1, 1, 1, 5, 5, 0, 0},
     true},
    {"outside",
     "triangle_halfspace_signed_distance",
     raised_triangle + floor_plane,
     {5, 0, 0, -1, 5, 5, 5, 1, 1, 0},
     false},
    {"other_place", "box_halfspace_signed_distance", raised_cube + floor_plane, {4, 0, 0, -1, 1, 0, 4, 3, 0, 0}, true},
    {"inside", "box_halfspace_signed_distance", raised_cube + floor_plane, {4, 0, 0, -1, 0, 0, 5, 0, 0, 0}, false},
    // Down from height 2 at speed 1: at time 2.
    {"elsewhere", "moving_point_plane", Values{1, 1, 2, 0, 0, -1} + floor_plane, {2, 3, 1, 0, 0, 0, 1}, true},
    {"above", "moving_point_plane", Values{1, 1, 2, 0, 0, -1} + floor_plane, {2, 1, 1, four_ulps, 0, 0, 1}, false},
    {"elsewhere", "moving_point_triangle", Values{1, 1, 2, 0, 0, -1} + triangle, {2, 2, 1, 0, 0, 0, 1}, true},
    {"above", "moving_point_triangle", Values{1, 1, 2, 0, 0, -1} + triangle, {2, 1, 1, four_ulps, 0, 0, 1}, false},
    {"in_the_plane", "moving_point_triangle", Values{1, 1, 2, 0, 0, -1} + triangle, {2, 3, 3, 0, 0, 0, 1}, false},
    {"elsewhere", "moving_point_triangle_prepared", Values{1, 1, 2, 0, 0, -1} + triangle, {2, 2, 1, 0, 0, 0, 1}, true},
    {"in_the_plane",
     "moving_point_triangle_prepared",
     Values{1, 1, 2, 0, 0, -1} + triangle,
     {2, 3, 3, 0, 0, 0, 1},
     false},
    {"other_half", "moving_point_rectangle", Values{2, 1, 2, 0, 0, -1} + square, {2, 1, 3, 0, 0, 0, 1}, true},
    {"in_the_plane", "moving_point_rectangle", Values{2, 1, 2, 0, 0, -1} + square, {2, 5, 1, 0, 0, 0, 1}, false},
    // Radius 3 around 0: from (-5, 0, 0) at speed 2, and from inside, where a solid ball is hit at the start.
    {"other_side", "moving_point_sphere", {-5, 0, 0, 2, 0, 0, 0, 0, 0, 3, 1}, {1, 0, 3, 0, -1, 0, 0}, true},
    {"inside", "moving_point_sphere", {-5, 0, 0, 2, 0, 0, 0, 0, 0, 3, 1}, {1, -2, 0, 0, -1, 0, 0}, false},
    {"pushed_out", "moving_point_sphere", {1, 0, 0, 1, 0, 0, 0, 0, 0, 3, 1}, {0, 3, 0, 0, 1, 0, 0}, true},
    {"elsewhere_inside", "moving_point_sphere", {1, 0, 0, 1, 0, 0, 0, 0, 0, 3, 1}, {0, 2, 0, 0, 1, 0, 0}, false},
    {"still_inside_hollow", "moving_point_sphere", {1, 0, 0, 1, 0, 0, 0, 0, 0, 3, 0}, {2, 1, 0, 0, 1, 0, 0}, false},
    // Down onto the capsule's top (2, 0, 1): its caps are round.
    {"along", "moving_point_capsule", Values{2, 0, 5, 0, 0, -1} + capsule, {4, 3, 0, 1, 0, 0, 1}, true},
    {"on_the_cap", "moving_point_capsule", Values{2, 0, 5, 0, 0, -1} + capsule, {4, 5, 0, 0, 0, 0, 1}, true},
    {"beside_the_cap", "moving_point_capsule", Values{2, 0, 5, 0, 0, -1} + capsule, {4, 5, 0, 1, 0, 0, 1}, false},
    {"inside", "moving_point_capsule", Values{2, 0, 5, 0, 0, -1} + capsule, {4, 2, 0, 0.5, 0, 0, 1}, false},
    // Onto the face x = 1 of the cube.
    {"at_a_corner", "moving_point_box", Values{3, 0, 0, -1, 0, 0} + cube, {2, 1, 1, 1, 1, 0, 0}, true},
    {"inside", "moving_point_box", Values{3, 0, 0, -1, 0, 0} + cube, {2, 1 - four_ulps, 0, 0, 1, 0, 0}, false},
    {"in_the_plane", "moving_point_box", Values{3, 0, 0, -1, 0, 0} + cube, {2, 1, 1.5, 0, 1, 0, 0}, false},
    {"inside", "moving_point_aabox", Values{3, 0, 0, -1, 0, 0} + aligned, {0, 0.5, 0, 0, 2, 1, 0, 0}, false},
    {"elsewhere", "moving_point_aabox", Values{3, 0, 0, -1, 0, 0} + aligned, {0, 0, 0, 1, 2, 1, 0, 0}, true},
    {"inside", "ray_aabox", Values{3, 0, 0, -1, 0, 0} + aligned, {0, 0.5, 0, 0}, false},
    {"elsewhere", "ray_aabox", Values{3, 0, 0, -1, 0, 0} + aligned, {0, 0, -1, 0}, true},
    {"at_its_origin", "ray_aabox", Values{3, 0, 0, -1, 0, 0} + aligned, {0, 3, 0, 0}, true},
    // A ball of radius 1 above: its contact point is on the ball, not on the obstacle.
    {"elsewhere", "moving_sphere_plane", Values{1, 1, 5, 1, 0, 0, -1} + floor_plane, {4, 2, 1, 0, 0, 0, 1}, true},
    {"on_the_ball", "moving_sphere_plane", Values{1, 1, 5, 1, 0, 0, -1} + floor_plane, {4, 1, 2, 1, 0, 0, 1}, false},
    {"elsewhere",
     "moving_sphere_triangle",
     Values{1, 1, 5, 1, 0, 0, -1} + triangle,
     {4, 2, 1, 0, 0, 0, 1, 0.5, 0.25, 0.25},
     true},
    {"on_the_ball",
     "moving_sphere_triangle",
     Values{1, 1, 5, 1, 0, 0, -1} + triangle,
     {4, 1, 2, 1, 0, 0, 1, 0.5, 0.25, 0.25},
     false},
    {"other_half", "moving_sphere_rectangle", Values{2, 1, 5, 1, 0, 0, -1} + square, {4, 1, 2, 0, 0, 0, 1}, true},
    {"in_the_plane", "moving_sphere_rectangle", Values{2, 1, 5, 1, 0, 0, -1} + square, {4, 5, 1, 0, 0, 0, 1}, false},
    {"other_side", "moving_sphere_sphere", {5, 0, 0, 1, -1, 0, 0, 0, 0, 0, 2}, {2, 0, 2, 0, 1, 0, 0}, true},
    {"on_the_moving_one", "moving_sphere_sphere", {5, 0, 0, 1, -1, 0, 0, 0, 0, 0, 2}, {2, 3, 1, 0, 1, 0, 0}, false},
    {"along", "moving_sphere_capsule", Values{2, 0, 5, 1, 0, 0, -1} + capsule, {3, 3, 0, 1, 0, 0, 1}, true},
    {"on_the_axis", "moving_sphere_capsule", Values{2, 0, 5, 1, 0, 0, -1} + capsule, {3, 2, 0, 0, 0, 0, 1}, false},
    {"other_face", "moving_sphere_box", Values{5, 0, 0, 1, -1, 0, 0} + cube, {3, 0, 1, 0, 1, 0, 0}, true},
    {"beside", "moving_sphere_box", Values{5, 0, 0, 1, -1, 0, 0} + cube, {3, 1, 2, 0, 1, 0, 0}, false},
    // Along the rotated cube's first axis: (3/5, 4/5, 0) is its face's middle; (1, 0, 0) is 2/5 inside that face and
    // 1/5 inside the adjacent one.
    {"turned_elsewhere",
     "moving_sphere_box",
     Values{6, 8, 0, 1, -3, -4, 0} + turned,
     {1.6, -0.6, -0.8, 0, 0.6, 0.8, 0},
     true},
    {"turned_inside", "moving_sphere_box", Values{6, 8, 0, 1, -3, -4, 0} + turned, {1.6, 1, 0, 0, 0.6, 0.8, 0}, false},
    // Down at speed 1.
    {"elsewhere", "moving_point_halfspace", Values{1, 1, 5} + down + floor_plane, {5, 3, 1, 0, 0, 0, 1}, true},
    {"above", "moving_point_halfspace", Values{1, 1, 5} + down + floor_plane, {5, 1, 1, 1, 0, 0, 1}, false},
    {"elsewhere", "moving_sphere_halfspace", Values{1, 1, 5, 1} + down + floor_plane, {4, 2, 1, 0, 0, 0, 1}, true},
    {"above", "moving_sphere_halfspace", Values{1, 1, 5, 1} + down + floor_plane, {4, 1, 1, 1, 0, 0, 1}, false},
    {"elsewhere", "moving_segment_halfspace", raised + down + floor_plane, {5, 3, 0, 0, 0, 0, 1}, true},
    {"above", "moving_segment_halfspace", raised + down + floor_plane, {5, 1, 0, 1, 0, 0, 1}, false},
    {"elsewhere", "moving_capsule_halfspace", raised + Values{1} + down + floor_plane, {4, 3, 0, 0, 0, 0, 1}, true},
    {"above", "moving_capsule_halfspace", raised + Values{1} + down + floor_plane, {4, 1, 0, 1, 0, 0, 1}, false},
    {"elsewhere", "moving_triangle_halfspace", raised_triangle + down + floor_plane, {5, 5, 0, 0, 0, 0, 1}, true},
    {"above", "moving_triangle_halfspace", raised_triangle + down + floor_plane, {5, 1, 1, 1, 0, 0, 1}, false},
    {"elsewhere", "moving_box_halfspace", raised_cube + down + floor_plane, {4, 3, 0, 0, 0, 0, 1}, true},
    {"above", "moving_box_halfspace", raised_cube + down + floor_plane, {4, 0, 0, 1, 0, 0, 1}, false},
    // Balls of radius 2 at distance 3: the first one's deepest point is (2, 0, 0), the second one's (1, 0, 0).
    {"other_side", "sphere_sphere_penetration", {0, 0, 0, 2, 3, 0, 0, 2}, {1, 1, 0, 0, 0, 2, 0}, true},
    {"of_the_other", "sphere_sphere_penetration", {0, 0, 0, 2, 3, 0, 0, 2}, {1, 1, 0, 0, 1, 0, 0}, false},
    {"other_side", "sphere_plane_penetration", Values{0, 0, 0.5, 1} + floor_plane, {0.5, 0, 0, 1, 1, 0, 0.5}, true},
    {"on_the_plane", "sphere_plane_penetration", Values{0, 0, 0.5, 1} + floor_plane, {0.5, 0, 0, 1, 0, 0, 0}, false},
    // The box's nearest point (1, 0, 0), or the ball's deepest point.
    {"other_face", "sphere_box_penetration", Values{3, 0, 0, 3} + cube, {1, -1, 0, 0, 0, 0, 1}, true},
    {"deepest", "sphere_box_penetration", Values{3, 0, 0, 3} + cube, {1, -1, 0, 0, 0, 0, 0}, true},
    {"between", "sphere_box_penetration", Values{3, 0, 0, 3} + cube, {1, -1, 0, 0, 0.5, 0, 0}, false},
    {"in_a_face", "box_plane_penetration", Values{0, 0, 0.5, 1, 1, 1, 0, 0, 0, 1} + floor_plane, corners(0, 0, -0.5),
     true},
    {"beside", "box_plane_penetration", Values{0, 0, 0.5, 1, 1, 1, 0, 0, 0, 1} + floor_plane, corners(-1, -2, -0.5),
     false},
    {"inside", "box_plane_penetration", Values{0, 0, 0.5, 1, 1, 1, 0, 0, 0, 1} + floor_plane, corners(0, 0, 0), false},
};

class PlaceByHand : public testing::TestWithParam<Placed> {};

TEST_P(PlaceByHand, IsToldFromOneOffTheSurface) {
  const Placed& p = GetParam();
  const Case c{find_query(p.query), Scalar::float64, p.inputs, "hand", 0, 0, {}};
  ASSERT_EQ(c.values.size(), c.fields().size());
  ASSERT_EQ(p.answer.size(), c.query->outputs.size());
  Answer a;
  a.yes = true;
  std::copy(p.answer.begin(), p.answer.end(), a.values.begin());
  const Finding f = judge(c, a, strict, Detail::full);
  EXPECT_EQ(f.verdict, Verdict::violates_contract);
  EXPECT_EQ(name_of(f.disagreement), name_of(p.on_surface ? Disagreement::wrong_place : Disagreement::off_surface));
}

INSTANTIATE_TEST_SUITE_P(Placed, PlaceByHand, testing::ValuesIn(placed),
                         [](const auto& test) { return std::string(test.param.query) + "_" + test.param.name; });

/// Every query that answers with a place, except those whose place lies between two surfaces or is a vector of numbers.
bool answers_with_a_place(const Query& query) {
  if (query.kind == Kind::measure || query.name == "box_box_penetration") return false;
  return std::any_of(query.outputs.begin(), query.outputs.end(),
                     [](const Field& f) { return f.role == Role::position; });
}

TEST(Surfaces, AreNamedByEveryQueryThatAnswersWithAPlace) {
  std::set<std::string_view> by_hand;
  for (const Placed& p : placed) by_hand.insert(p.query);
  for (const Query& query : catalogue()) {
    EXPECT_EQ(oracle_of(query).may_be_on_surface != nullptr, answers_with_a_place(query)) << query.name;
    EXPECT_EQ(by_hand.contains(query.name), answers_with_a_place(query)) << query.name;
  }
}

/// A number from -1 to 1 that depends on the arguments alone.
double wobble(std::uint64_t a, std::uint64_t b) {
  std::uint64_t z = a * 0x9e3779b97f4a7c15u + b * 0xd1342543de82ef95u + 0x2545f4914f6cdd1du;
  z = (z ^ (z >> 31)) * 0xbf58476d1ce4e5b9u;
  return double(std::int64_t(z ^ (z >> 29))) * 0x1p-63;
}

/// An input within the widening of the given one; empty if it breaks a rule.
std::optional<Case> perturbed(const Case& c, std::span<const double> wide, std::uint64_t salt) {
  Case p = c;
  for (std::size_t i = 0; i < p.values.size(); ++i) {
    double x = c.values[i] + wide[i] * wobble(salt, i);
    while (std::abs(x - c.values[i]) > wide[i]) x = std::nextafter(x, c.values[i]);
    p.values[i] = c.role(i) == Role::size ? std::max(0.0, x) : x;
  }
  if (p.query->broken(p.values)) return std::nullopt;
  return p;
}

class OnSurface : public testing::TestWithParam<NamedQuery> {
 protected:
  static constexpr std::uint64_t cases = 600;

  const Query& query() const { return *GetParam().query; }
  /// The indices of the first numbers of its places.
  std::vector<std::size_t> places() const {
    std::vector<std::size_t> first;
    for (std::size_t i = 0; i < query().outputs.size(); i += query().outputs[i].role == Role::position ? 3 : 1) {
      if (query().outputs[i].role == Role::position) first.push_back(i);
    }
    return first;
  }
  /// Every right yes-answer, rounded.
  static std::vector<Answer> right_answers(const Case& c) {
    AlternativeList list;
    (void)oracle_of(*c.query).exact(c.values, Answer{}, c.scalar, &list);
    std::vector<Answer> answers;
    for (const Alternative& a : list.all) {
      Answer answer;
      answer.yes = a.yes;
      for (std::size_t i = 0; i < a.count; ++i) answer.values[i] = 0.5 * a.values[i].low + 0.5 * a.values[i].high;
      if (a.yes) answers.push_back(answer);
    }
    return answers;
  }
  bool may_be(const Case& c, std::span<const double> wide, const Answer& a, std::size_t place) const {
    return oracle_of(query()).may_be_on_surface(c.values, wide, a, place, 1, c.scalar);
  }
};

/// The right place of an input lies on the surface of that input, and of every input whose widening contains it.
TEST_P(OnSurface, IsEveryRightPlace) {
  int asked = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const Case c = generate(query(), Scalar::float64, 51, i);
    const double k = std::ldexp(1.0, int(i % 50));
    const std::vector<double> wide = widening(query(), c.values, c.scalar, k), still(c.values.size(), 0.0);
    const std::optional<Case> p = perturbed(c, wide, i);
    if (!p) continue;
    for (const Answer& right : right_answers(*p)) {
      for (const std::size_t place : places()) {
        ASSERT_TRUE(may_be(*p, still, right, place)) << case_to_json(*p).dump() << ", number " << place;
        ASSERT_TRUE(may_be(c, wide, right, place)) << case_to_json(c).dump() << ", k = " << k << ", number " << place;
        ++asked;
      }
    }
  }
  EXPECT_GT(asked, int(cases) / 10);
}

/// A place that is off by a thousandth of its size is nearly always detected, and by at least 2^20 epsilon.
TEST_P(OnSurface, IsHardlyAPlaceThatIsMovedAtRandom) {
  int found = 0, found_widened = 0, asked = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const Case c = generate(query(), Scalar::float64, 52, i);
    if (!c.moves.empty()) continue;
    const std::vector<double> wide = widening(query(), c.values, c.scalar, 0x1p20), still(c.values.size(), 0.0);
    for (Answer a : right_answers(c)) {
      const std::size_t place = places().front();
      double size = 0;
      for (std::size_t k = place; k < place + 3; ++k) size = std::max(size, std::abs(a.values[k]));
      if (size == 0) continue;
      for (std::size_t k = place; k < place + 3; ++k) a.values[k] += 0x1p-10 * size * wobble(i, k);
      ++asked;
      found += !may_be(c, still, a, place);
      found_widened += !may_be(c, wide, a, place);
    }
  }
  EXPECT_GT(asked, 20);
  EXPECT_GT(found, asked * 9 / 10) << "of " << asked;
  EXPECT_GT(found_widened, asked * 9 / 10) << "of " << asked;
}

std::vector<NamedQuery> queries_with_places() {
  std::vector<NamedQuery> all;
  for (const NamedQuery& q : every_query()) {
    if (answers_with_a_place(*q.query)) all.push_back(q);
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Every, OnSurface, testing::ValuesIn(queries_with_places()), testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss
