/// Causes of findings, continued: evidence that holds for nearly every case anyway proves nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "reports/tests/mistaken_subject.hpp"
#include "reports/triage/causes/shares.hpp"

namespace nearmiss {
namespace {

TEST(Shares, HaveBoundsThatOneSampleInTwentyExceeds) {
  EXPECT_NEAR(proved_at_least(5, 5), std::pow(0.05, 1.0 / 5), 1e-12);
  EXPECT_NEAR(proved_at_most(0, 5), 1 - std::pow(0.05, 1.0 / 5), 1e-12);
  EXPECT_LT(proved_at_most(32, 64), 0.9);
  EXPECT_GT(proved_at_most(56, 64), 0.9);
  EXPECT_EQ(proved_at_least(0, 0), 0);
  EXPECT_EQ(proved_at_most(0, 0), 1);
}

/// Of the motions in a plane of coordinates, those that begin left of the other sphere are misses.
Answer misses_some_along_axes(Numbers q) {
  Answer a = exact_answer("moving_sphere_sphere", q);
  const bool is_along_axes = q[4] == 0 || q[5] == 0 || q[6] == 0;
  if (!is_along_axes || q[0] + q[1] > q[7] + q[8]) return a;
  a.yes = false;
  a.values[0] = INFINITY;
  return a;
}

TEST(EvidenceOfACause, ARegionOfRightAndWrongAnswersIsNoCause) {
  const Subject s = subject_with("moving_sphere_sphere", misses_some_along_axes);
  const Case c = in_double("moving_sphere_sphere", {-3, 0.25, 0.5, 0.5, 1.5, 0.125, 0, 0, 0, 0, 1});
  EXPECT_NE(cause_found(s, c).kind, CauseKind::unsupported) << cause_text(cause_found(s, c));
}

/// sphere_sphere_penetration: center, radius, twice; the answer is a depth, a normal, a place. The direction of a point
/// that is further than the nearest one by a two-thousandth.
Answer direction_of_a_near_point(Numbers q) {
  Answer a = exact_answer("sphere_sphere_penetration", q);
  const double n[] = {a.values[1], a.values[2], a.values[3]};
  const double angle = 0.03 * (1 + n[0] * n[1]), across = std::hypot(n[0], n[1]);
  if (!a.yes || !(across > 0)) return a;
  a.values[1] = n[0] * std::cos(angle) - n[1] / across * std::sin(angle);
  a.values[2] = n[1] * std::cos(angle) + n[0] / across * std::sin(angle);
  a.values[3] = n[2] * std::cos(angle);
  const double size = std::hypot(a.values[1], a.values[2], a.values[3]);
  for (std::size_t k = 1; k < 4; ++k) a.values[k] /= size;
  return a;
}

TEST(EvidenceOfACause, ANormalNearTheRightOneIsNoMistakeOfLogic) {
  const Subject s = subject_with("sphere_sphere_penetration", direction_of_a_near_point);
  const Case c = in_double("sphere_sphere_penetration", {0.1, 0.2, 0.3, 0.9, 0.8, 0.7, 0.2, 0.7});
  const Cause cause = cause_found(s, c);
  EXPECT_NE(cause.kind, CauseKind::logic) << cause_text(cause);
}

/// moving_point_sphere: point, velocity, center, radius, solid. A time of contact that rounding puts below 0 is
/// dropped, and so is that of a start inside: the contact is where the ray leaves.
Answer drops_what_rounding_puts_before_the_start(Numbers q) {
  Answer a = exact_answer("moving_point_sphere", q);
  const volatile double xx = (q[0] - q[6]) * (q[0] - q[6]), yy = (q[1] - q[7]) * (q[1] - q[7]),
                        zz = (q[2] - q[8]) * (q[2] - q[8]), rr = q[9] * q[9], xy = xx + yy, square = xy + zz;
  if (!a.yes || a.values[0] > 0 || !(square < rr)) return a;
  const double v[] = {q[3], q[4], q[5]};
  double along = 0, speed2 = 0;
  for (std::size_t k = 0; k < 3; ++k) along += (q[k] - q[6 + k]) * v[k], speed2 += v[k] * v[k];
  a.values[0] = (-along + std::sqrt(along * along - speed2 * (square - rr))) / speed2;
  for (std::size_t k = 0; k < 3; ++k) {
    a.values[1 + k] = q[k] + a.values[0] * v[k];
    a.values[4 + k] = (a.values[1 + k] - q[6 + k]) / q[9];
  }
  return a;
}

TEST(EvidenceOfACause, AMeaningDoesNotDependOnTheRounding) {
  const Subject s = subject_with("moving_point_sphere", drops_what_rounding_puts_before_the_start);
  Workers workers;
  std::vector<Case> touching;
  for (int n = 1; touching.empty() && n < 1000; ++n) {
    const double k = std::ldexp(std::floor(std::ldexp(0.1 + 0.001 * n, 48)), -48);  // 3 k, 4 k and 5 k are exact
    const Case c = in_double("moving_point_sphere", {3 * k, 4 * k, 0, -1, -0.75, 0.125, 0, 0, 0, 5 * k, 1});
    workers.send(s, {&c, 1}, Rounding::upward);
    const bool is_right_upward = workers.receive(s).front().values[0] == 0;
    if (is_right_upward && is_bad(examine(c, s, workers).finding)) touching.push_back(c);
  }
  ASSERT_FALSE(touching.empty());
  const Cause cause = cause_found(s, touching.front());
  EXPECT_NE(cause.kind, CauseKind::convention) << cause_text(cause);
  EXPECT_NE(cause.key, "flag ignored") << cause_text(cause);
}

/// Breaks where the square of a speed leaves the range of double, though all lengths are small.
Answer breaks_for_fast_motions(Numbers q) {
  if (std::isinf(q[4] * q[4])) return Answer::without(Answer::Status::broke, "exception: no unit vector");
  return exact_answer("moving_sphere_sphere", q);
}

TEST(EvidenceOfACause, TheRangeIsThatOfTheMultipliedNumbers) {
  const Subject s = subject_with("moving_sphere_sphere", breaks_for_fast_motions);
  const Case c =
      in_double("moving_sphere_sphere", {-0x1p-300, 0x1p-304, 0, 0x1p-302, 0x1p600, 0x1p597, 0, 0, 0, 0, 0x1p-301});
  const Cause cause = cause_found(s, c);
  EXPECT_EQ(cause.kind, CauseKind::overflow) << cause_text(cause);
}

}  // namespace
}  // namespace nearmiss
