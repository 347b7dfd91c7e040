/// Causes of findings, continued: what contradicts a cause, and causes of contacts of another thing.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "reports/tests/mistaken_subject.hpp"
#include "reports/triage/causes/cause_json.hpp"

namespace nearmiss {
namespace {

bool tells(const Cause& c, std::string_view words) { return cause_text(c).find(words) != std::string::npos; }

// moving_sphere_sphere: center, radius, velocity, fixed center, fixed radius; the answer is a time, a place, a normal.

double distance_at_start(Numbers q) { return std::hypot(q[0] - q[7], q[1] - q[8], q[2] - q[9]); }
Answer a_miss() {
  Answer a;
  a.yes = false;
  a.values[0] = INFINITY;
  return a;
}
bool is_in_contact(Numbers q) { return distance_at_start(q) <= q[3] + q[10]; }
constexpr std::initializer_list<double> a_flight{-20.3, 0.1, 0.2, 0.4, 1.7, 0.1, 0, 1.9, 1.3, 0.1, 0.5};

Answer misses_what_is_far(Numbers q) {
  return distance_at_start(q) > 7.3 * (q[3] + q[10]) ? a_miss() : exact_answer("moving_sphere_sphere", q);
}

TEST(PreciseCause, OneJumpAlongAMotionIsNoIteration) {
  const Subject s = subject_with("moving_sphere_sphere", misses_what_is_far);
  const Cause c = cause_found(s, in_double("moving_sphere_sphere", a_flight));
  EXPECT_NE(c.kind, CauseKind::iteration_limit) << cause_text(c);
}

/// An area is compared with a constant, and stripes of the motion are left out.
Answer misses_stripes_of_large_scenes(Numbers q) {
  const bool is_striped = std::fmod(std::abs(q[0] / q[10]), 3.1) < 1.7;
  const bool is_large = std::abs(q[0] * q[7] * q[10]) + q[4] * q[4] > 3.7;
  return is_striped && is_large ? a_miss() : exact_answer("moving_sphere_sphere", q);
}

TEST(PreciseCause, NothingHoldsAtEveryScaleThatIsRightAtOne) {
  const Subject s = subject_with("moving_sphere_sphere", misses_stripes_of_large_scenes);
  const Cause c = cause_found(s, in_double("moving_sphere_sphere", a_flight));
  EXPECT_FALSE(tells(c, "the answer is right with 2^") && c.text.find("every scale") != std::string::npos)
      << cause_text(c);
  EXPECT_NE(c.kind, CauseKind::iteration_limit) << cause_text(c);
}

/// Small spheres are searched for from the largest number on, which is squared.
Answer starts_at_the_largest_number(Numbers q) {
  Answer a = exact_answer("sphere_sphere_overlap", q);
  if (q[3] > 0.1) return a;
  volatile double best = std::numeric_limits<double>::max();
  best = best * best;
  a.yes = best < 1;
  return a;
}

TEST(PreciseCause, NumbersOfUnitSizeOverflowNothing) {
  const Subject s = subject_with("sphere_sphere_overlap", starts_at_the_largest_number);
  const Cause c = cause_found(s, in_double("sphere_sphere_overlap", {0.1, 0.2, 0.3, 0.07, 1.3, 0.2, 0.3, 1.9}));
  EXPECT_NE(c.kind, CauseKind::overflow) << cause_text(c);
}

/// Which branch is taken depends on rounding, and one of them is wrong by half of the radius.
Answer wrong_by_half_a_radius(Numbers q) {
  Answer a = exact_answer("sphere_sphere_penetration", q);
  const volatile double part = q[0] * q[5] + q[1] * q[4], other = q[0] * q[5], rest = part - other;
  if (a.yes && rest - q[1] * q[4] > 0) a.values[0] += q[3] / 2 + std::abs(q[1]) / 8;
  return a;
}

TEST(PreciseCause, RoundingErrorsAreSmall) {
  const Subject s = subject_with("sphere_sphere_penetration", wrong_by_half_a_radius);
  const Cause c = cause_found(s, first_wrong(s));
  EXPECT_NE(c.kind, CauseKind::rounding) << cause_text(c);
}

/// Of one start in contact of sixteen the normal is the velocity.
Answer reversed_in_contact(Numbers q) {
  Answer a = exact_answer("moving_sphere_sphere", q);
  if (!a.yes || !is_in_contact(q)) return a;
  const double speed = std::hypot(q[4], q[5], q[6]);
  const bool is_odd = std::fmod(std::abs(q[0]) * 1000, 1) < 0.07 && speed > 0;
  for (std::size_t k = 0; k < 3; ++k) a.values[4 + k] = is_odd ? q[4 + (k + 1) % 3] / speed : -a.values[4 + k];
  return a;
}

TEST(PreciseCause, AReadingOfNearlyAllStartsInContactSaysMoreThanTheRegion) {
  const Subject s = subject_with("moving_sphere_sphere", reversed_in_contact);
  const Cause c = cause_found(s, first_wrong(s));
  EXPECT_FALSE(c.kind == CauseKind::unsupported && tells(c, "normal reversed")) << cause_text(c);
  EXPECT_NE(c.key, "a start in contact") << cause_text(c);
}

/// Numbers below 2^-40 are kept out, and fast motions are misses.
Answer misses_fast_motions(Numbers q) {
  const double speed = std::hypot(q[4], q[5], q[6]);
  const bool is_tiny = distance_at_start(q) < 0x1p-40;
  return speed > 1.1 * std::abs(q[1] - 3) && !is_tiny ? a_miss() : exact_answer("moving_sphere_sphere", q);
}

TEST(PreciseCause, WhatIsNotTheCauseIsNotNamed) {
  const Subject s = subject_with("moving_sphere_sphere", misses_fast_motions);
  std::vector<double> fast = a_flight;
  for (const std::size_t i : {4, 5, 6}) fast[i] *= 16;
  const Cause c = cause_found(s, in_double("moving_sphere_sphere", fast));
  EXPECT_FALSE(c.kind == CauseKind::absolute_tolerance && tells(c, "is not the cause")) << cause_text(c);
}

/// The hits at time 0 are right. The normals of a few more hits are wrong too.
Answer velocity_for_normal(Numbers q) {
  Answer a = exact_answer("moving_sphere_sphere", q);
  const bool is_near = distance_at_start(q) <= 1.03 * (q[3] + q[10]);
  if (!a.yes || !is_near) return a;
  for (std::size_t k = 0; k < 3; ++k) a.values[4 + k] = q[4 + (k + 1) % 3];
  return a;
}

TEST(PreciseCause, AHitAtTheStartIsNoMeaningWhereItIsRight) {
  const Subject s = subject_with("moving_sphere_sphere", velocity_for_normal);
  const Cause c = cause_found(s, first_wrong(s));
  EXPECT_NE(c.key, "start in contact is a hit") << cause_text(c);
}

Answer aborts_by_chance(Numbers q) {
  std::uint64_t hash = 0x9E3779B97F4A7C15u;
  for (const double x : q) hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0xD6E8FEB86659FD93u, hash ^= hash >> 32;
  if (hash % 3 == 0) return Answer::without(Answer::Status::broke, "assertion failed");
  return exact_answer("sphere_sphere_overlap", q);
}

TEST(PreciseCause, AbortsByChanceAreNoToleranceAndNoRounding) {
  const Subject s = subject_with("sphere_sphere_overlap", aborts_by_chance);
  const Cause c = cause_found(s, first_wrong(s));
  EXPECT_EQ(c.kind, CauseKind::unexplained) << cause_text(c);
}

/// Of a moving sphere that is larger than the fixed one.
Answer misses_of_large_spheres(Numbers q) {
  return q[3] > 1.37 * q[10] ? a_miss() : exact_answer("moving_sphere_sphere", q);
}

TEST(PreciseCause, AMeaningThatMissesAlwaysSaysNothingAboutAMiss) {
  const Subject s = subject_with("moving_sphere_sphere", misses_of_large_spheres);
  const Cause c = cause_found(s, first_wrong(s));
  EXPECT_FALSE(tells(c, "velocity reversed")) << cause_text(c);
  EXPECT_NE(c.kind, CauseKind::convention) << cause_text(c);
}

Answer reversed_velocity(Numbers q) {
  std::vector<double> values(q.begin(), q.end());
  for (std::size_t k = 4; k < 7; ++k) values[k] = -values[k];
  return exact_answer("moving_sphere_sphere", values);
}

TEST(PreciseCause, AMeaningThatFindsTheHitsOfOthersExplainsAMiss) {
  const Subject s = subject_with("moving_sphere_sphere", reversed_velocity);
  expect_cause(cause_found(s, in_double("moving_sphere_sphere", a_flight)), CauseKind::convention, "velocity reversed");
}

// Contacts of another thing

Answer negative_in_contact(Numbers q) {
  Answer a = exact_answer("moving_sphere_sphere", q);
  if (a.yes && is_in_contact(q)) a.values[0] = distance_at_start(q) - q[3] - q[10];
  return a;
}
/// sphere_sphere_penetration: center, radius, twice; the answer is a depth, a normal, a place.
Answer center_for_contact(Numbers q) {
  Answer a = exact_answer("sphere_sphere_penetration", q);
  for (std::size_t k = 0; a.yes && k < 3; ++k) a.values[4 + k] = q[4 + k];
  return a;
}
Answer divided_by_the_radii(Numbers q) {
  Answer a = exact_answer("sphere_sphere_penetration", q);
  const double distance = std::hypot(q[0] - q[4], q[1] - q[5], q[2] - q[6]);
  const bool has_direction = a.yes && distance > 0;
  for (std::size_t k = 1; has_direction && k < 4; ++k) a.values[k] *= distance / (q[3] + q[7]);
  return a;
}
/// moving_sphere_triangle: center, radius, velocity, corners; the answer is a time, a place, a normal.
Answer normal_of_the_triangle(Numbers q) {
  Answer a = exact_answer("moving_sphere_triangle", q);
  if (!a.yes) return a;
  double n[3], size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    n[k] = (q[10 + i] - q[7 + i]) * (q[13 + j] - q[7 + j]) - (q[10 + j] - q[7 + j]) * (q[13 + i] - q[7 + i]);
    size = std::hypot(size, n[k]);
  }
  for (std::size_t k = 0; k < 3 && size > 0; ++k) a.values[4 + k] = n[k] / size;
  return a;
}
Answer corner_before_edges(Numbers q) {
  Answer a = exact_answer("moving_sphere_triangle", q);
  if (!a.yes || a.values[0] == 0) return a;
  for (std::size_t corner = 7; corner < 16; corner += 3) {
    const std::vector<double> alone{q[0], q[1],      q[2],          q[3],          q[4], q[5],
                                    q[6], q[corner], q[corner + 1], q[corner + 2], 0};
    const Answer of_corner = exact_answer("moving_sphere_sphere", alone);
    if (!of_corner.yes) continue;
    std::copy_n(of_corner.values.begin(), 7, a.values.begin());
    for (std::size_t k = 0; k < 3; ++k) a.values[1 + k] = q[corner + k];
    for (std::size_t k = 0; k < 3; ++k) a.values[7 + k] = (corner - 7) / 3 == k ? 1 : 0;
    return a;
  }
  return a;
}
/// sphere_box_penetration: center, radius, center, half extents, quaternion.
Answer face_of_largest_coordinate(Numbers q) {
  const std::vector<double> upright{q[0], q[1], q[2], q[3], q[4], q[5], q[6], q[7], q[8], q[9], 0, 0, 0, 1};
  std::vector<double> values(q.begin(), q.end());
  const double n = q[10] * q[10] + q[11] * q[11] + q[12] * q[12] + q[13] * q[13], x = q[10], y = q[11], z = q[12],
               w = q[13];
  const double axes[3][3] = {{n - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
                             {2 * (x * y - w * z), n - 2 * (x * x + z * z), 2 * (y * z + w * x)},
                             {2 * (x * z + w * y), 2 * (y * z - w * x), n - 2 * (x * x + y * y)}};
  double at[3];
  bool is_inside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    at[k] = 0;
    for (std::size_t i = 0; i < 3; ++i) at[k] += axes[k][i] / n * (q[i] - q[4 + i]);
    at[k] = std::abs(at[k]), is_inside = is_inside && at[k] < q[7 + k];
  }
  const std::size_t face = std::size_t(std::max_element(at, at + 3) - at);
  for (std::size_t k = 0; k < 3 && is_inside; ++k) {
    if (k != face) values[7 + k] = std::max(q[7 + k], at[k] + 2 * (q[7 + face] - at[face]));
  }
  return exact_answer("sphere_box_penetration", values);
}
TEST(PreciseCause, OfAContactOfAnotherThing) {
  struct Planted {
    const char* query;
    Answering answer;
    CauseKind kind;
    const char* key;
  };
  const Planted all[] = {
      {"moving_sphere_sphere", negative_in_contact, CauseKind::convention, "negative time"},
      {"sphere_sphere_penetration", center_for_contact, CauseKind::convention, "center in place of the contact"},
      {"moving_sphere_triangle", normal_of_the_triangle, CauseKind::convention, "normal of a face"},
      {"moving_sphere_triangle", corner_before_edges, CauseKind::logic, "corner in place of the contact"},
      {"sphere_box_penetration", face_of_largest_coordinate, CauseKind::logic, "face of the largest coordinate"},
  };
  for (const Planted& p : all) {
    SCOPED_TRACE(p.query);
    const Subject s = subject_with(p.query, p.answer);
    expect_cause(cause_found(s, first_wrong(s)), p.kind, p.key);
  }
}

TEST(PreciseCause, TellsWhatANormalIsDividedBy) {
  Subject s = subject_with("sphere_sphere_penetration", divided_by_the_radii);
  s.offerings[0].contract.unit = 64;
  const Cause c = cause_found(s, in_double("sphere_sphere_penetration", {0.1, 0.2, 0.3, 0.5, 0.6, 0.1, 0.2, 0.7}));
  expect_cause(c, CauseKind::convention, "normal not of unit length");
  EXPECT_TRUE(tells(c, "the sum of the radii")) << cause_text(c);
}

/// moving_point_plane: point, velocity, normal, offset. Hits from behind count, with the normal of the front.
Answer two_sided_with_front_normal(Numbers q) {
  Answer a = exact_answer("moving_point_plane", q);
  std::vector<double> reversed(q.begin(), q.end());
  for (std::size_t k = 6; k < 10; ++k) reversed[k] = -reversed[k];
  if (a.yes) return a;
  a = exact_answer("moving_point_plane", reversed);
  for (std::size_t k = 4; k < 7 && a.yes; ++k) a.values[k] = -a.values[k];
  return a;
}
/// sphere_plane_penetration: center, radius, normal, offset. The half-space lies on the other side; its normal does
/// not.
Answer half_space_of_the_inverse_pose(Numbers q) {
  std::vector<double> reversed(q.begin(), q.end());
  for (std::size_t k = 4; k < 8; ++k) reversed[k] = -reversed[k];
  Answer a = exact_answer("sphere_plane_penetration", reversed);
  for (std::size_t k = 1; k < 4 && a.yes; ++k) a.values[k] = -a.values[k];
  return a;
}

TEST(PreciseCause, TwoMeaningsMayHoldAtOnce) {
  const Subject two_sided = subject_with("moving_point_plane", two_sided_with_front_normal);
  const Case behind = in_double("moving_point_plane", {0, 0, -2, 0, 0, 1, 0, 0, 1, 0});
  expect_cause(cause_found(two_sided, behind), CauseKind::convention, "both sides");
  const Subject inverse = subject_with("sphere_plane_penetration", half_space_of_the_inverse_pose);
  for (const double height : {2.0, -2.0, 0.25}) {  // a false hit, a false miss, and a wrong depth
    const Case c = in_double("sphere_plane_penetration", {0, 0, height, 0.5, 0, 0, 1, 0});
    expect_cause(cause_found(inverse, c), CauseKind::convention, "back for front");
  }
}

/// moving_point_sphere. Of a start in contact the normal points the other way; at the center it is none.
Answer inward_and_undefined(Numbers q) {
  Answer a = exact_answer("moving_point_sphere", q);
  const double distance = std::hypot(q[0] - q[6], q[1] - q[7], q[2] - q[8]);
  if (!a.yes || distance > q[9]) return a;
  for (std::size_t k = 4; k < 7; ++k) a.values[k] = distance == 0 ? NAN : -a.values[k];
  return a;
}

/// Starts in contact have another bug, too, which is no reason to leave out the region of this one.
TEST(PreciseCause, ARegionIsToldByItsOwnFinding) {
  const Subject s = subject_with("moving_point_sphere", inward_and_undefined);
  const Case c = in_double("moving_point_sphere", {1, 2, 3, 2, 4, -4, 1, 2, 3, 1, 1});
  expect_cause(cause_found(s, c), CauseKind::unsupported, "two equal points");
}

TEST(PreciseCause, TwoThatPassAreBothTold) {
  Cause cause;
  static_cast<CauseName&>(cause) = {CauseKind::rounding, "", "It rounds."};
  cause.either.push_back({CauseKind::absolute_tolerance, "1e-6 length", "It compares."});
  EXPECT_EQ(names_of(cause), "rounding, or absolute tolerance (1e-6 length)");
  EXPECT_EQ(sentences_of(cause), "It rounds. Or: It compares.");
  const nlohmann::json j = cause_to_json(cause);
  const std::string file = "cause.json";
  EXPECT_EQ(nlohmann::json(cause_to_json(cause_from_json(FileValue(j, file)))), j);
}

}  // namespace
}  // namespace nearmiss
