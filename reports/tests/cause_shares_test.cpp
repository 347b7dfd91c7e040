/// Causes of findings, continued: shares of a length, steps, limiting cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "corpus/generator/generator.hpp"
#include "oracles/judge.hpp"
#include "reports/tests/mistaken_subject.hpp"
#include "reports/triage/geometry/quantities.hpp"
#include "reports/triage/geometry/ratios.hpp"
#include "reports/triage/trials/touch_cases.hpp"

namespace nearmiss {
namespace {

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
  if (a.yes) a.values[0] *= 1 + std::ldexp(std::copysign(2.0, a.values[1]) + a.values[1] * a.values[2], -digits);
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

Answer longer_distance(Numbers q) {
  Answer a = exact_answer("box_box_projected_distance", q);
  const double reach = q[3] + q[4] + q[5] + q[13] + q[14] + q[15];
  a.values[0] -= std::ldexp(reach + q[4] * std::abs(std::sin(q[0])), -27);
  return a;
}

TEST(CauseOfAShare, SmallErrorsToOneSideAreNoFloats) {
  const Subject s = subject_with("box_box_projected_distance", longer_distance);
  expect_cause(cause_found(s, first_wrong(s)), CauseKind::relative_tolerance, "");
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

/// closest_point_triangle_perimeter: v0, v1, v2, point. The edge is that whose infinite line is nearest.
Answer edge_by_its_line(Numbers q) {
  Answer best = exact_answer("closest_point_triangle_perimeter", q);
  double least = INFINITY;
  for (std::size_t i = 0; i < 3; ++i) {
    const double *from = &q[3 * i], *to = &q[3 * ((i + 1) % 3)];
    double along[3], away[3], cross2 = 0, length2 = 0;
    for (std::size_t k = 0; k < 3; ++k) along[k] = to[k] - from[k], away[k] = q[9 + k] - from[k];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
      cross2 += std::pow(along[a] * away[b] - along[b] * away[a], 2), length2 += along[k] * along[k];
    }
    if (!(cross2 / length2 < least)) continue;
    const double segment[] = {from[0], from[1], from[2], to[0], to[1], to[2], q[9], q[10], q[11]};
    least = cross2 / length2, best = exact_answer("closest_point_segment", segment);
  }
  return best;
}

/// The ends of edges are some of the given numbers.
TEST(CauseOfSteps, AreNotTheCornersOfAShape) {
  const Subject s = subject_with("closest_point_triangle_perimeter", edge_by_its_line);
  Workers workers;
  std::size_t found = 0;
  for (std::uint64_t i = 0; found < 8; ++i) {
    Case c;
    generate_inside(c, *find_query(s.offerings[0].query), s.scalar, 1, i, {});
    if (has_extreme_mutator(c) || !is_bad(examine(c, s, workers).finding)) continue;
    const Cause named = cause_found(s, c);
    EXPECT_NE(named.kind, CauseKind::iteration_limit) << cause_text(named);
    ++found;
  }
}

/// moving_sphere_sphere: center, radius, velocity, fixed center, fixed radius. The fixed sphere is too large for one
/// that starts outside of the large one.
Answer larger_from_far_away(Numbers q) {
  std::vector<double> values(q.begin(), q.end());
  values[10] *= 1.5;
  const double distance = std::hypot(q[0] - q[7], q[1] - q[8], q[2] - q[9]);
  return exact_answer("moving_sphere_sphere", distance > q[3] + values[10] ? values : std::vector(q.begin(), q.end()));
}

TEST(CauseOfSteps, AreNotOneWrongContactOfEveryStart) {
  const Subject s = subject_with("moving_sphere_sphere", larger_from_far_away);
  const Cause c =
      cause_found(s, in_double("moving_sphere_sphere", {-5.3, 0.1, 0.2, 0.4, 1.7, 0.1, 0, 1.9, 0.3, 0.1, 1.1}));
  EXPECT_NE(c.kind, CauseKind::iteration_limit) << cause_text(c);
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

Answer overlap_of_floats(Numbers q) {
  std::vector<double> values(q.begin(), q.end());
  for (double& x : values) x = double(float(x));
  return exact_answer("sphere_sphere_overlap", values);
}

TEST(CasesAtTouches, ErrOnBothSidesWhereASubjectRounds) {
  const Case question = in_double("sphere_sphere_overlap", {0.1, 0.2, 0.3, 0.5, 1.3, 0.2, 0.3, 0.7 - 1e-9});
  for (const bool rounds : {true, false}) {
    const Subject s = subject_with("sphere_sphere_overlap", rounds ? overlap_of_floats : larger_square);
    Workers workers;
    Trials trials(question, s, {}, workers);
    std::vector<Case> generated(32);
    std::uint64_t index = 0;
    for (Case& c : generated) {  // without mutators: spheres that are tiny for their place let both subjects round
      do generate_inside(c, trials.query(), s.scalar, 3, index++, {});
      while (!c.moves.empty());
    }
    EXPECT_EQ(errs_beyond_touches(trials, trials.ask(generated)), rounds);
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

/// moving_sphere_sphere: center, radius, velocity and others; the answer is a time, a place and a normal.
Answer misses_grazing_contacts(Numbers q) {
  Answer a = exact_answer("moving_sphere_sphere", q);
  const double along = q[4] * a.values[4] + q[5] * a.values[5] + q[6] * a.values[6];
  if (a.yes && a.values[0] > 0 && std::abs(along) < 0.13 * std::hypot(q[4], q[5], q[6])) a.yes = false;
  return a;
}

TEST(CauseOfAShare, ContactsThatGrazeAreStepsAlongTheMotion) {
  const Subject s = subject_with("moving_sphere_sphere", misses_grazing_contacts);
  expect_cause(cause_found(s, first_wrong(s)), CauseKind::iteration_limit, "steps along the motion");
}

double distance2_of(Numbers q) {
  const double x = q[0] - q[4], y = q[1] - q[5], z = q[2] - q[6];
  return x * x + y * y + z * z;
}
Answer squares_in_the_range_of_floats(Numbers q) {
  constexpr double highest = 0x1p128, lowest = 0x1p-149;
  const double d2 = distance2_of(q), r2 = (q[3] + q[7]) * (q[3] + q[7]);
  Answer a = exact_answer("sphere_sphere_overlap", q);
  if (std::min(d2, r2) > highest || std::max(d2, r2) < lowest) a.yes = true;
  return a;
}
Answer root_in_a_few_steps(Numbers q) {
  const double d2 = distance2_of(q);
  double root = 1;
  for (int i = 0; i < 16; ++i) root = (root + d2 / root) / 2;
  Answer a = exact_answer("sphere_sphere_overlap", q);
  if (a.yes && d2 > 0) a.yes = root <= q[3] + q[7];
  return a;
}

TEST(CauseOfAShare, WhatIsWrongForLargeAndForSmallNumbersIsARange) {
  const Subject floats = subject_with("sphere_sphere_overlap", squares_in_the_range_of_floats);
  const Case far = in_double("sphere_sphere_overlap", {0x1p66, 0, 0, 0x1p64, 0, 0x1p65, 0, 0x1p64});
  expect_cause(cause_found(floats, far), CauseKind::overflow, "lengths and velocities");
  const Subject steps = subject_with("sphere_sphere_overlap", root_in_a_few_steps);
  const Case large = in_double("sphere_sphere_overlap", {0x1p17, 0, 0, 0x1.8p16, 0, 0x1p15, 0, 0x1.8p16});
  const Cause unknown = cause_found(steps, large);  // constants at both ends would look the same
  EXPECT_EQ(unknown.kind, CauseKind::unexplained) << cause_text(unknown);
}

Answer no_point(Numbers q) {
  Answer a = exact_answer("sphere_sphere_overlap", q);
  if (q[7] == 0) a.yes = false;
  return a;
}

TEST(CauseOfAShare, ARegionMayBeWrongForOneDecisionAlone) {
  const Subject s = subject_with("sphere_sphere_overlap", no_point);
  expect_cause(cause_found(s, first_wrong(s)), CauseKind::unsupported, "sphere2.radius of zero");
}

}  // namespace
}  // namespace nearmiss
