/// Causes of findings, continued: shares of a length, steps, operands and frames, limiting cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "corpus/fit.hpp"
#include "corpus/generator.hpp"
#include "impl/subject/provenance.hpp"
#include "oracles/judge.hpp"
#include "reports/triage/cause.hpp"
#include "reports/triage/quantities.hpp"
#include "reports/triage/ratios.hpp"
#include "reports/triage/touch_cases.hpp"

namespace nearmiss {
namespace {

using Numbers = std::span<const double>;
using Answering = Answer (*)(Numbers);

Answer exact_answer(const char* query, Numbers values) {
  static const Subject certified = [] {
    for (const Subject& own : own_subjects_in_process()) {
      if (own.name == "collide-certified-double") return own;
    }
    throw std::logic_error("no certified tier");
  }();
  const Answer a = certified.offering(query).answer(values);
  std::feclearexcept(FE_OVERFLOW | FE_UNDERFLOW);  // those of exact arithmetic are none of the mistaken subject's
  return a;
}

/// A subject with a mistake in one query, and the contract of a precise one.
Subject subject_with(const char* query, Answering answer) {
  Subject s{.name = "mistaken", .version = "1", .scalar = Scalar::float64, .offerings = {}};
  s.offerings.push_back({query, Offer::answers, "", collide::Contract{.backward = 64}, answer, {}});
  return s;
}

Case in_double(const char* query, std::vector<double> values) {
  return {find_query(query), Scalar::float64, std::move(values), "test", 0, 0, {}};
}

Cause cause_found(const Subject& subject, const Case& question) {
  Workers workers;
  const Report report = examine(question, subject, workers);
  EXPECT_TRUE(is_bad(report.finding)) << "the mistake is not found";
  return cause_of(report, subject, {.time = std::chrono::hours(1)}, workers);  // also on a busy machine
}

/// The first generated case that counts against the subject.
Case first_wrong(const Subject& s) {
  Workers workers;
  for (std::uint64_t i = 0; i < 5000; ++i) {
    Case c;
    generate_inside(c, *find_query(s.offerings[0].query), s.scalar, 1, i, {});
    if (!has_extreme_mutator(c) && is_bad(examine(c, s, workers).finding)) return c;
  }
  throw std::logic_error("no finding");
}

void expect_cause(const Cause& c, CauseKind kind, const std::string& key) {
  EXPECT_EQ(c.kind, kind) << cause_text(c);
  EXPECT_EQ(c.key, key) << cause_text(c);
}

// sphere_sphere_overlap: center1 x y z, radius1, center2 x y z, radius2.

Answer larger_square(Numbers q) {
  const double x = q[0] - q[4], y = q[1] - q[5], z = q[2] - q[6], r = q[3] + q[7];
  Answer a;
  a.yes = x * x + y * y + z * z <= r * r * (1 + 1e-6);
  return a;
}

TEST(CauseOfAShare, OfASquaredDistance) {
  const Subject s = subject_with("sphere_sphere_overlap", larger_square);
  const Cause c = cause_found(s, in_double("sphere_sphere_overlap", {0.1, 0.2, 0.3, 0.5, 1.3, 0.2, 0.3, 0.7 - 4.1e-8}));
  expect_cause(c, CauseKind::relative_tolerance, "5e-7");
}

Answer larger_box(Numbers q) {
  std::vector<double> values(q.begin(), q.end());
  for (std::size_t i = 3; i < 6; ++i) values[i] *= 1 + 1e-3;
  return exact_answer("box_box_conservative", values);
}

TEST(CauseOfAShare, OfABoxThatIsLarger) {
  const Subject s = subject_with("box_box_conservative", larger_box);
  expect_cause(cause_found(s, first_wrong(s)), CauseKind::relative_tolerance, "1e-3");
}

Answer longer_depth(Numbers q) {
  Answer a = exact_answer("sphere_plane_penetration", q);
  if (a.yes) a.values[0] *= 1 + 1e-6;
  return a;
}

TEST(CauseOfAShare, OfANumberOfTheAnswer) {
  const Subject s = subject_with("sphere_plane_penetration", longer_depth);
  expect_cause(cause_found(s, first_wrong(s)), CauseKind::relative_tolerance, "1e-6");
}

template <int digits>
Answer nearly_right_depth(Numbers q) {
  Answer a = exact_answer("sphere_sphere_penetration", q);
  if (a.yes) a.values[0] *= 1 + std::ldexp(2 + a.values[1] * a.values[2], -digits);
  return a;
}

TEST(CauseOfAShare, SmallErrorsAreATolerance) {
  const Subject s = subject_with("sphere_sphere_penetration", nearly_right_depth<17>);
  expect_cause(cause_found(s, first_wrong(s)), CauseKind::relative_tolerance, "");
}

TEST(CauseOfAShare, ErrorsOfFloatsAreRounding) {
  const Subject s = subject_with("sphere_sphere_penetration", nearly_right_depth<26>);
  expect_cause(cause_found(s, first_wrong(s)), CauseKind::rounding, "single precision");
}

// closest_point_segment: v0, v1, point.

Answer halves_the_segment(Numbers q) {
  double low = 0, high = 1;
  const double along[] = {q[3] - q[0], q[4] - q[1], q[5] - q[2]};
  for (int i = 0; i < 12; ++i) {
    const double middle = (low + high) / 2;
    double side = 0;
    for (std::size_t k = 0; k < 3; ++k) side += (q[k] + along[k] * middle - q[6 + k]) * along[k];
    (side < 0 ? low : high) = middle;
  }
  Answer a = exact_answer("closest_point_segment", q);
  for (std::size_t k = 0; k < 3; ++k) a.values[k] = q[k] + along[k] * (low + high) / 2;
  return a;
}

TEST(CauseOfSteps, AreFewPlacesOfASegment) {
  const Subject s = subject_with("closest_point_segment", halves_the_segment);
  const Cause c = cause_found(s, in_double("closest_point_segment", {0, 0, 0, 3, 1, 2, 1.1, 0.7, 0.9}));
  expect_cause(c, CauseKind::iteration_limit, "steps of the answer");
}

/// moving_sphere_passes_sphere: center, radius, velocity, fixed center, fixed radius, limit, forever. Looks at 17
/// times.
Answer looks_at_times(Numbers q) {
  Answer a = exact_answer("moving_sphere_passes_sphere", q);
  bool touches = false;
  for (int i = 0; i <= 16; ++i) {
    const double t = q[11] * i / 16;
    const double at[] = {q[0] + q[4] * t, q[1] + q[5] * t, q[2] + q[6] * t, q[3], q[7], q[8], q[9], q[10]};
    touches = touches || exact_answer("sphere_sphere_overlap", at).yes;
  }
  a.yes = a.yes && touches;
  return a;
}

TEST(CauseOfSteps, AreFewTimesOfALongMotion) {
  const Subject s = subject_with("moving_sphere_passes_sphere", looks_at_times);
  const Cause c = cause_found(
      s, in_double("moving_sphere_passes_sphere", {-20.3, 0.1, 0.2, 0.4, 1.7, 0.1, 0, 1.9, 1.3, 0.1, 0.5, 300, 0}));
  expect_cause(c, CauseKind::iteration_limit, "steps along the motion");
}

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
      {"moving_sphere_passes_sphere", until_time_one, CauseKind::convention, "motion ends at time 1"},
  };
  for (const Planted& p : all) {
    SCOPED_TRACE(p.query);
    const Subject s = subject_with(p.query, p.answer);
    expect_cause(cause_found(s, first_wrong(s)), p.kind, p.key);
  }
}

/// sphere_plane_penetration: center, radius, normal, offset.
Answer not_for_thin_overlaps(Numbers q) {
  Answer a = exact_answer("sphere_plane_penetration", q);
  if (a.yes && a.values[0] < 1e-5) a.yes = false, a.values[0] = -1e-5;
  return a;
}

TEST(CauseOfALimitingCase, IsFoundInAnotherCase) {
  const Subject s = subject_with("sphere_plane_penetration", not_for_thin_overlaps);
  const Cause c = cause_found(s, in_double("sphere_plane_penetration", {0, 0, 0.5, 0.5, 0, 0, 1, 0}));
  EXPECT_EQ(c.kind, CauseKind::absolute_tolerance) << cause_text(c);
}

TEST(CasesAtTouches, HaveTheFindingNearABorder) {
  const Subject s = subject_with("sphere_sphere_overlap", larger_square);
  const Case question = in_double("sphere_sphere_overlap", {0.1, 0.2, 0.3, 0.5, 1.3, 0.2, 0.3, 0.7 - 4.1e-8});
  Workers workers;
  Trials trials(question, s, {}, workers);
  std::vector<Case> generated(24);
  std::uint64_t index = 0;
  for (Case& c : generated) generate_inside(c, trials.query(), s.scalar, 3, index++, {});
  const std::vector<Trial> found = cases_at_touches(trials, trials.ask(generated), 4);
  EXPECT_EQ(found.size(), 4u);
  for (const Trial& t : found) {
    EXPECT_EQ(t.outcome, Outcome::same);
    EXPECT_FALSE(exact_decision(t.question));
    EXPECT_GT(gap_of(t.question), 0);
  }
}

TEST(Ratios, OfOneNumberAreAFamily) {
  const Ratios ratios(in_double("box_box_conservative", {0, 0, 0, 1, 2, 3, 0, 0, 0, 1, 5, 1, 1, 2, 1, 1, 0, 0, 1, 1}));
  std::size_t with_one_number = 0;
  std::string family;
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    if (ratios.name(i) == "the gap along axis 3 over the reach of box1 along axis 3") family = ratios.family(i);
  }
  for (std::size_t i = 0; i < ratios.size(); ++i) with_one_number += ratios.family(i) == family;
  EXPECT_EQ(with_one_number, 15u);  // not every gap with every reach
}

}  // namespace
}  // namespace nearmiss
