/// Causes of findings, continued: other meanings of the inputs and of the answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "oracles/judge.hpp"
#include "reports/tests/mistaken_subject.hpp"
#include "reports/triage/hypotheses/readings.hpp"

namespace nearmiss {
namespace {

Answer second_upright(Numbers q) {
  std::vector<double> values(q.begin(), q.end());
  std::fill_n(values.begin() + 16, 3, 0.0);
  values[19] = 1;
  return exact_answer("box_box_overlap", values);
}
Answer second_is_a_point(Numbers q) {
  std::vector<double> values(q.begin(), q.end());
  values[7] = 0;
  return exact_answer("sphere_sphere_penetration", values);
}
/// Turned back by the rotation of the box.
Answer normal_of_the_box(Numbers q) {
  Answer a = exact_answer("moving_point_box", q);
  if (!a.yes) return a;
  const double *r = &q[12], n = r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3];
  double *v = &a.values[4], c[3], d[3];
  for (std::size_t k = 0; k < 3; ++k) c[k] = r[(k + 2) % 3] * v[(k + 1) % 3] - r[(k + 1) % 3] * v[(k + 2) % 3];
  for (std::size_t k = 0; k < 3; ++k) d[k] = r[(k + 2) % 3] * c[(k + 1) % 3] - r[(k + 1) % 3] * c[(k + 2) % 3];
  for (std::size_t k = 0; k < 3; ++k) v[k] += 2 / n * (r[3] * c[k] + d[k]);
  return a;
}

/// The exact oracle takes no number that is not finite.
TEST(CauseOfAReading, OfABoxOfTheLargestFloatsAsksNothingInfinite) {
  constexpr double large = 0x1.8p127;
  const Case c{find_query("sphere_box_penetration"),
               Scalar::float32,
               {0, 0, 0, 1, 0, 0, 0, large, large, large, 0, 0, 0, 1},
               "",
               0,
               0,
               {}};
  Answer a;
  a.yes = true;
  a.count = std::uint8_t(c.query->outputs.size());
  for (const Reading& r : readings_of_contacts()) {
    (void)r.right(c, a, [&](const Case& other, const Answer&) {
      for (const double x : other.values) EXPECT_TRUE(std::isfinite(x)) << r.name;
      return false;
    });
  }
}

TEST(CauseOfAReading, OfOneOperandAlone) {
  const Subject upright = subject_with("box_box_overlap", second_upright);
  expect_cause(cause_found(upright, first_wrong(upright)), CauseKind::unsupported, "rotation ignored");
  const Subject point = subject_with("sphere_sphere_penetration", second_is_a_point);
  expect_cause(cause_found(point, first_wrong(point)), CauseKind::unsupported, "radius ignored");
}

TEST(CauseOfAReading, OfAFrame) {
  const Subject s = subject_with("moving_point_box", normal_of_the_box);
  expect_cause(cause_found(s, first_wrong(s)), CauseKind::convention, "normal in the frame of the box");
}

Answer time_over_speed(Numbers q) {
  Answer a = exact_answer("moving_sphere_sphere", q);
  if (a.yes) a.values[0] /= std::hypot(q[4], q[5], q[6]);
  return a;
}

TEST(CauseOfAReading, ExplainsALimitingCaseThroughTheOthers) {
  const Subject s = subject_with("moving_sphere_sphere", time_over_speed);
  const Cause c = cause_found(s, in_double("moving_sphere_sphere", {0.5, 0, 0, 1, 0, 0, 0, 1, 0.25, 0, 1}));
  expect_cause(c, CauseKind::convention, "time over speed");
}

/// moving_point_triangle: point, velocity, triangle. A contact before the start counts.
Answer along_the_line(Numbers q) {
  const double *p = &q[0], *v = &q[3], *v0 = &q[6];
  double normal[3], approach = 0, height = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    normal[k] = (q[9 + i] - v0[i]) * (q[12 + j] - v0[j]) - (q[9 + j] - v0[j]) * (q[12 + i] - v0[i]);
    approach -= normal[k] * v[k], height += normal[k] * (p[k] - v0[k]);
  }
  if (!(approach > 0 && height < 0)) return exact_answer("moving_point_triangle", q);
  const double time = height / approach;
  std::vector<double> earlier(q.begin(), q.end());
  for (std::size_t k = 0; k < 3; ++k) earlier[k] += 2 * time * v[k];
  Answer a = exact_answer("moving_point_triangle", earlier);
  if (a.yes) a.values[0] += 2 * time;
  return a;
}
/// ray: origin, direction; aabox: min, max.
Answer leaves_the_box(Numbers q) {
  Answer a = exact_answer("ray_aabox", q);
  std::vector<double> back(q.begin(), q.end());
  for (std::size_t k = 0; k < 3; ++k) back[k] += 64 * q[3 + k], back[3 + k] = -q[3 + k];
  const Answer last = exact_answer("ray_aabox", back);
  if (a.yes && last.yes) a.values = last.values;
  return a;
}
Answer first_for_second(Numbers q) {
  Answer a = exact_answer("box_box_info", q);
  const std::size_t size = find_query("box_box_info")->outputs.size();
  std::copy_n(a.values.begin() + std::ptrdiff_t(size) - 6, 3, a.values.begin() + std::ptrdiff_t(size) - 3);
  return a;
}
Answer operands_exchanged(Numbers q) {
  const std::vector<double> exchanged{q[4], q[5], q[6], q[7], q[0], q[1], q[2], q[3]};
  return exact_answer("sphere_sphere_penetration", exchanged);
}

Answer longer_direction(Numbers q) {
  Answer a = exact_answer("bounce_direction", q);
  for (std::size_t k = 0; k < 3; ++k) a.values[k] *= 3;
  return a;
}
Answer unit_direction(Numbers q) {
  Answer a = exact_answer("slide_direction", q);
  const double norm = std::hypot(a.values[0], a.values[1], a.values[2]);
  for (std::size_t k = 0; k < 3 && norm > 0; ++k) a.values[k] /= norm;
  return a;
}
/// moving_point_sphere: point, velocity, and others. At the exit the normal points along the velocity.
Answer exit_against_the_motion(Numbers q) {
  Answer a = exact_answer("moving_point_sphere", q);
  double along = 0;
  for (std::size_t k = 0; k < 3; ++k) along += a.values[4 + k] * q[3 + k];
  for (std::size_t k = 4; k < 7 && a.yes && along > 0; ++k) a.values[k] = -a.values[k];
  return a;
}
/// sphere_plane_penetration: center, radius, normal, offset.
Answer out_at_the_back(Numbers q) {
  std::vector<double> values(q.begin(), q.end());
  const bool behind = q[0] * q[4] + q[1] * q[5] + q[2] * q[6] + q[7] < 0;
  for (std::size_t k = 4; k < 8 && behind; ++k) values[k] = -values[k];
  return exact_answer("sphere_plane_penetration", values);
}
/// The case with every input of this role replaced.
std::vector<double> with_role(const char* query, Numbers q, Role role, double value) {
  std::vector<double> values(q.begin(), q.end());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (find_query(query)->inputs[i].role == role) values[i] = value;
  }
  return values;
}
Answer without_axis(Numbers q) {
  return exact_answer("point_in_triangle", with_role("point_in_triangle", q, Role::index, -1));
}
Answer until_time_one(Numbers q) {
  const char* query = "moving_sphere_passes_sphere";
  const double limit = q[12] != 0 ? 1 : std::min(q[11], 1.0);
  return exact_answer(query, with_role(query, with_role(query, q, Role::time, limit), Role::flag, 0));
}
Answer weights_rotated(Numbers q) {
  Answer a = exact_answer("point_in_triangle", q);
  for (const Layout::Part& p : find_query("point_in_triangle")->layout.parts) {
    const auto begin = a.values.begin() + std::ptrdiff_t(p.begin);
    if (p.role == Role::weight) std::rotate(begin, begin + 1, a.values.begin() + std::ptrdiff_t(p.end));
  }
  return a;
}

/// closest_point_triangle_perimeter_edges gives a point and an edge.
Answer opposite_vertex(Numbers q) {
  Answer a = exact_answer("closest_point_triangle_perimeter_edges", q);
  a.values[3] = double((int(a.values[3]) + 2) % 3);
  return a;
}

/// Corners 2 and 3 are exchanged.
Answer corners_of_a_strip(Numbers q) {
  std::vector<double> values(q.begin(), q.end());
  std::swap_ranges(values.begin() + 6, values.begin() + 9, values.begin() + 9);
  return exact_answer("closest_point_rectangle_perimeter", values);
}
/// moving_point_aabox: point, velocity, and the corners of the box.
Answer size_of_the_box(Numbers q) {
  std::vector<double> values(q.begin(), q.end());
  for (std::size_t k = 6; k < 9; ++k) values[k + 3] = q[k] + std::max(q[k + 3], 0.0);
  return exact_answer("moving_point_aabox", values);
}
/// moving_point_sphere: point, velocity, and others.
Answer end_of_the_motion(Numbers q) {
  std::vector<double> values(q.begin(), q.end());
  for (std::size_t k = 0; k < 3; ++k) values[3 + k] -= q[k];
  return exact_answer("moving_point_sphere", values);
}
/// sphere_triangle_overlap: center, radius, triangle. A center behind the face overlaps nothing.
Answer culled_from_behind(Numbers q) {
  double height = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double normal =
        (q[7 + i] - q[4 + i]) * (q[10 + j] - q[4 + j]) - (q[7 + j] - q[4 + j]) * (q[10 + i] - q[4 + i]);
    height += normal * (q[k] - q[4 + k]);
  }
  Answer a = exact_answer("sphere_triangle_overlap", q);
  if (height < 0) a.yes = false;
  return a;
}

TEST(CauseOfAReading, OfAContactBeforeTheStart) {
  const Subject s = subject_with("moving_point_triangle", along_the_line);
  const Case c =
      in_double("moving_point_triangle", {0.25, 0.3, -1.1, 0.1, 0.2, -1, 0, 0, 0.1, 1.5, 0, 0.2, 0, 1.4, 0.1});
  expect_cause(cause_found(s, c), CauseKind::convention, "contact before the start");
}

TEST(CauseOfAReading, OfAnotherContactOrValue) {
  struct Planted {
    const char* query;
    Answering answer;
    CauseKind kind;
    const char* key;
  };
  const Planted all[] = {
      {"ray_aabox", leaves_the_box, CauseKind::convention, "contact where it leaves"},
      {"box_box_info", first_for_second, CauseKind::logic, "value of another"},
      {"sphere_sphere_penetration", operands_exchanged, CauseKind::convention, "operands exchanged"},
      {"bounce_direction", longer_direction, CauseKind::convention, "direction not of unit length"},
      {"slide_direction", unit_direction, CauseKind::convention, "direction of unit length"},
      {"moving_point_sphere", exit_against_the_motion, CauseKind::convention, "normal reversed"},
      {"sphere_plane_penetration", out_at_the_back, CauseKind::convention, "plane with two fronts"},
      {"point_in_triangle", without_axis, CauseKind::unsupported, "axis ignored"},
      {"point_in_triangle", weights_rotated, CauseKind::convention, "weights in another order"},
      {"closest_point_triangle_perimeter_edges", opposite_vertex, CauseKind::convention, "index of the one before"},
      {"moving_sphere_passes_sphere", until_time_one, CauseKind::convention, "motion ends at time 1"},
      {"closest_point_rectangle_perimeter", corners_of_a_strip, CauseKind::convention, "corners of a strip"},
      {"moving_point_aabox", size_of_the_box, CauseKind::convention, "size in place of a corner"},
      {"moving_point_sphere", end_of_the_motion, CauseKind::convention, "end in place of the velocity"},
      {"sphere_triangle_overlap", culled_from_behind, CauseKind::unsupported, "a hit from behind the triangle"},
  };
  for (const Planted& p : all) {
    SCOPED_TRACE(p.query);
    const Subject s = subject_with(p.query, p.answer);
    expect_cause(cause_found(s, first_wrong(s)), p.kind, p.key);
  }
}

}  // namespace
}  // namespace nearmiss
