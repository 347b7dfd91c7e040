/// For sets of right answers, the given answer is compared with the nearest member. A member is never judged further
/// off than its rounding, and an answer more than a few ulps from every member is detected. The test builds the members
/// in long double from the definition of the query, and asks the oracle about them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "oracles/exact/oracle.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {
namespace {

using Real = long double;
using Vec = std::array<Real, 3>;
using Numbers = std::vector<double>;

Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec operator*(Real s, const Vec& a) { return {s * a[0], s * a[1], s * a[2]}; }
Real dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec unit(const Vec& a) { return (1 / std::sqrt(dot(a, a))) * a; }

Numbers operator+(Numbers a, const Numbers& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}
Numbers operator+(Numbers a, const Vec& b) {
  for (const Real x : b) a.push_back(double(x));
  return a;
}

double rounded(Real x, Scalar s) { return s == Scalar::float32 ? double(float(x)) : double(x); }

struct Exchange {
  Case question;
  Answer answer;
};

Exchange asked(const char* query, Numbers inputs, bool yes, const Numbers& answer, Scalar scalar = Scalar::float64) {
  Exchange a{{find_query(query), scalar, std::move(inputs), "built", 0, 0, {}}, {}};
  EXPECT_EQ(a.question.values.size(), a.question.fields().size()) << query;
  EXPECT_FALSE(a.question.query->broken(a.question.values)) << query;
  a.answer.yes = yes;
  a.answer.given = (std::uint64_t{1} << answer.size()) - 1;
  for (std::size_t i = 0; i < answer.size(); ++i) a.answer.values[i] = rounded(answer[i], scalar);
  return a;
}

std::string text(const Exchange& a) {
  return std::string(a.question.query->name) + " " + testing::PrintToString(a.question.values) + " answer " +
         testing::PrintToString(Numbers(a.answer.values.begin(), a.answer.values.begin() + 11));
}

/// A contract that only a correctly rounded exact answer keeps, apart from the length of normals.
constexpr collide::Contract nearly_strict{.backward = 0, .forward = 1, .exact_decisions = true, .unit = 8};

Finding judged(const Exchange& a, Detail detail = Detail::full) {
  return judge(a.question, a.answer, nearly_strict, detail);
}

void expect_right(const Exchange& a, double ulps = 1) {
  const Finding f = judged(a);
  EXPECT_EQ(f.truth_yes, a.answer.yes) << text(a);
  EXPECT_LE(f.forward_ulps, ulps) << text(a) << ": " << name_of(f.disagreement);
  if (ulps > 1) return;
  EXPECT_EQ(f.verdict, Verdict::agrees) << text(a) << ": " << name_of(f.disagreement) << ", " << f.clause;
  EXPECT_EQ(judged(a, Detail::verdict).verdict, Verdict::agrees) << text(a);
}
void expect_wrong(const Exchange& a, double ulps) {
  const Finding f = judged(a);
  EXPECT_EQ(f.verdict, Verdict::violates_contract) << text(a) << ", " << f.forward_ulps << " ulps";
  EXPECT_GE(f.forward_ulps, ulps) << text(a);
}

// Minimal cases.

TEST(RightAnswers, OfConcentricSpheresArePairsOfANormalAndItsContact) {
  expect_right(asked("sphere_sphere_penetration", {-3, -4, 0, 5, -3, -4, 0, 1}, true, {6, 0.6, 0.8, 0, 0, 0, 0}));
  expect_wrong(asked("sphere_sphere_penetration", {-3, -4, 0, 5, -3, -4, 0, 1}, true, {6, 0.6, 0.8, 0, 0, 0, 0x1p-40}),
               1000);
  expect_wrong(asked("sphere_sphere_penetration", {-3, -4, 0, 5, -3, -4, 0, 1}, true, {6, 0, 1, 0, 0, 0, 0}), 0x1p45);
}

TEST(RightAnswers, OfACenterOnTheAxisArePairsOfANormalAndItsPlace) {
  expect_right(asked("moving_sphere_sphere", {-1, 19, 17, 4, 0, 0, 1, -1, 19, 17, 3}, true,
                     {0, -3.552713678800501e-15, 21.000000000000004, 19.000000000000004, 0.3333333333333334,
                      0.6666666666666666, 0.6666666666666666}));
}

TEST(RightAnswers, WeightsWithoutAreaAreComparedNumberByNumber) {
  for (int signs = 0; signs < 8; ++signs) {
    Numbers weights{7 / 16.0, 8 / 16.0, 1 / 16.0};
    for (int i = 0; i < 3; ++i) weights[i] += (signs >> i & 1) != 0 ? 0x1p-53 : -0x1p-53;
    expect_right(asked("point_in_triangle", {0, 0, 0, 1, 0, 0, 8, 0, 0, 0, 0, 1, -1, 1, 0, 0}, true, weights));
  }
}

TEST(RightAnswers, WeightsWithoutAreaAreNotNegative) {
  // The corners are (0, 0), (1, 0), (2, 0) and (0, 0): twice the first minus the second plus some of the third also
  // gives the point.
  expect_right(asked("point_in_triangle", {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0, 1, -1, 0, 0, 0}, true, {1, 0, 0}));
  expect_wrong(asked("point_in_triangle", {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0, 1, -1, 0, 0, 0}, true, {2, -2, 1}), 0x1p45);
  expect_right(asked("point_in_triangle", {3, 4, 5, 3, 4, 5, 3, 4, 5, 0, 0, 1, -1, 3, 4, 0}, true, {0.25, 0.75, 0}));
  expect_wrong(asked("point_in_triangle", {3, 4, 5, 3, 4, 5, 3, 4, 5, 0, 0, 1, -1, 3, 4, 0}, true, {2, -1, 0}), 0x1p45);
}

TEST(RightAnswers, AContactLiesAnywhereOnThePatch) {
  const Numbers cubes{0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1.5, 0, 0, 1, 1, 1, 0, 0, 0, 1, -1};
  for (const double y : {-1.0, -0.3, 0.0, 0.7, 1.0}) {
    for (const double z : {-1.0, 0.1, 1.0}) {
      expect_right(asked("box_box_penetration", cubes, true, {0.5, 0, 1, 0, 0, 0.75, y, z}));
    }
  }
  expect_wrong(asked("box_box_penetration", cubes, true, {0.5, 0, 1, 0, 0, 0.75, 1 + 0x1p-40, 0}), 1000);
  expect_wrong(asked("box_box_penetration", cubes, true, {0.5, 0, 1, 0, 0, 0.75 + 0x1p-40, 0.3, 0}), 1000);
}

TEST(RightAnswers, OfAFlatBoxTheNormalIsThatOfTheSideThatIsMet) {
  const Numbers flat{0, 0, 0, 1, 1, 0, 0, 0, 0, 1};
  const auto normal = [&](const Numbers& point, const Numbers& velocity, double time, double up) {
    const Numbers at{point[0] + velocity[0] * time, point[1] + velocity[1] * time, 0};
    const Numbers answer = Numbers{time} + at + Numbers{0, 0, up};
    return std::array{asked("moving_point_box", point + velocity + flat, true, answer),
                      asked("moving_sphere_box", point + Numbers{0} + velocity + flat, true, answer)};
  };
  for (const Exchange& a : normal({0, 0, 2}, {0, 0, -1}, 2, 1)) expect_right(a);
  for (const Exchange& a : normal({0, 0, 2}, {0, 0, -1}, 2, -1)) expect_wrong(a, 0x1p45);
  for (const Exchange& a : normal({0, 0, 0}, {0, 0, -1}, 0, 1)) expect_right(a);
  for (const Exchange& a : normal({0, 0, 0}, {0, 0, -1}, 0, -1)) expect_wrong(a, 0x1p45);
  for (const double side : {-1.0, 1.0}) {  // along the plane on either side
    for (const Exchange& a : normal({2, 0, 0}, {-1, 0, 0}, 1, side)) expect_right(a);
    for (const Exchange& a : normal({0, 0, 0}, {-1, 0, 0}, 0, side)) expect_right(a);
  }
  const Numbers flat_aligned{-1, -1, 0, 1, 1, 0};
  expect_right(asked("moving_point_aabox", Numbers{0, 0, 2, 0, 0, -1} + flat_aligned, true, {0, 0, 0, 0, 2, 0, 0, 1}));
  expect_wrong(asked("moving_point_aabox", Numbers{0, 0, 2, 0, 0, -1} + flat_aligned, true, {0, 0, 0, 0, 2, 0, 0, -1}),
               0x1p45);
}

TEST(RightAnswers, AMissByItsTimeStartsOutside) {
  const Numbers far{-1e300, 0, 0, 1e-300, 0, 0, -1, -1, -1, 1, 1, 1};
  expect_right(asked("moving_point_aabox", far, false, {0}));
  expect_wrong(asked("moving_point_aabox", far, false, {1}), 0);
}

// Random members. All coordinates are small dyadic numbers, so that the sets are exactly as intended.

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  int below(int n) { return int(random_() % std::uint64_t(n)); }
  int sign() { return below(2) == 0 ? -1 : 1; }
  Real uniform(Real low, Real high) { return low + (high - low) * (Real(random_() >> 1) * 0x1p-63L); }
  double number() { return (below(129) - 64) / 8.0; }
  double size(int octaves) { return std::ldexp(1 + below(8) / 8.0, below(2 * octaves + 1) - octaves); }
  Vec place() { return {number(), number(), number()}; }
  Vec direction() {
    for (;;) {
      const Vec v{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      if (dot(v, v) > 0.01L && dot(v, v) < 1) return unit(v);
    }
  }
  /// A vector of small integers, not zero.
  Vec axis() {
    for (;;) {
      const Vec v{Real(below(7) - 3), Real(below(7) - 3), Real(below(7) - 3)};
      if (dot(v, v) > 0) return v;
    }
  }

 private:
  std::mt19937_64 random_;
};

/// A case and one of its right answers: `before`, the vectors that belong to the set, `after`. Moving vector `leaving`
/// along `way` moves the answer out of the set by the same distance; -1: no such direction is known.
struct SetMember {
  const char* query;
  Numbers inputs, before;
  std::vector<Vec> vectors;
  int leaving = -1;
  Vec way{};
  Numbers after{};
};

constexpr int octaves = 10;     // of sizes relative to positions
constexpr int box_octaves = 3;  // of sizes whose sums must be exact, in float too

SetMember concentric(Draw& d) {
  const Vec c = d.place(), n = d.direction();
  const double r1 = d.size(octaves), r2 = d.size(octaves);
  return {"sphere_sphere_penetration", Numbers{} + c + Numbers{r1} + c + Numbers{r2}, {r1 + r2}, {n, c + r1 * n}, 1, n};
}
SetMember on_the_center(Draw& d) {
  const Vec c = d.place(), n = d.direction();
  const double own = d.size(octaves), radius = d.size(octaves);
  return {"moving_sphere_sphere",
          Numbers{} + c + Numbers{own} + d.axis() + c + Numbers{radius},
          {0},
          {c + radius * n, n},
          0,
          n};
}
/// On the axis of a capsule: in its middle perpendicular to it, at an end perpendicular or further outward.
SetMember on_the_axis(Draw& d) {
  const Vec p0 = d.place(), along = d.axis();
  const int halves = d.below(3);
  Vec n = d.direction();
  if (halves == 1 || d.below(2) == 0)
    n = unit(cross(along, n));
  else if ((halves == 0) == (dot(n, along) > 0))
    n = -1 * n;
  const double radius = d.size(octaves);
  const Vec center = p0 + Real(halves) / 2 * along;
  return {"moving_sphere_capsule",
          Numbers{} + center + Numbers{d.size(octaves)} + d.axis() + p0 + (p0 + along) + Numbers{radius},
          {0},
          {center + radius * n, n},
          0,
          halves == 1 && d.below(2) == 0 ? unit(along) : n};
}
/// A capsule of radius 0: the normals perpendicular to it, against the motion.
SetMember on_a_segment(Draw& d) {
  const Vec p0 = d.place(), along = d.axis(), v = d.axis(), center = p0 + 0.5L * along;
  Vec n = unit(cross(along, d.direction()));
  if (dot(n, v) > 0) n = -1 * n;
  return {"moving_point_capsule",
          Numbers{} + center + v + p0 + (p0 + along) + Numbers{0},
          {0},
          {center, n},
          1,
          unit(along)};
}

/// A box rotated about one axis by cosine 3/5 and sine 4/5, or unrotated; its half extents are multiples of 5.
struct ExactBox {
  std::array<Vec, 3> five_axes{Vec{5, 0, 0}, Vec{0, 5, 0}, Vec{0, 0, 5}};  ///< times 5: integers
  std::array<Vec, 3> axes{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};       ///< rounded
  Vec half{};
  Numbers orientation{0, 0, 0, 1};

  ExactBox(Draw& d, int about) : half{5 * d.size(box_octaves), 5 * d.size(box_octaves), 5 * d.size(box_octaves)} {
    if (about < 0) return;
    const Vec u = axes[(about + 1) % 3], v = axes[(about + 2) % 3];
    five_axes[(about + 1) % 3] = 3 * u + 4 * v;
    five_axes[(about + 2) % 3] = 3 * v + -4 * u;
    for (int i = 0; i < 3; ++i) axes[i] = 0.2L * five_axes[i];
    orientation = {0, 0, 0, 2};
    orientation[about] = 1;
  }
  Numbers at(const Vec& center) const { return Numbers{} + center + half + orientation; }
  /// A multiple of 5 along an axis, exactly.
  Vec along(int axis, Real length) const { return length / 5 * five_axes[axis]; }
};

/// Contact with an edge or a vertex, from outside or at the start; `as_ball`: by a ball of radius 0.
SetMember onto_a_box(Draw& d, bool as_ball) {
  const ExactBox box(d, d.below(4) - 1);
  const int level = d.below(4);  // the axis along the edge; 3: a vertex
  Vec place{}, n{}, v{};
  for (int i = 0; i < 3; ++i) {
    if (i == level) continue;
    const Real sign = d.sign();
    place = place + box.along(i, sign * box.half[i]);
    n = n + d.uniform(0, 1) * sign * box.axes[i];
    v = v + box.along(i, -5 * Real(1 + d.below(3)) * sign);
  }
  const Vec start = d.below(2) == 0 ? place : place - v;
  const Numbers ball = as_ball ? Numbers{0} : Numbers{};
  return {as_ball ? "moving_sphere_box" : "moving_point_box",
          Numbers{} + start + ball + v + box.at({0, 0, 0}),
          {start == place ? 0.0 : 1.0},
          {place, unit(n)},
          level < 3 ? 1 : -1,
          level < 3 ? box.axes[level] : Vec{}};
}
SetMember point_onto_a_box(Draw& d) { return onto_a_box(d, false); }
SetMember no_ball_onto_a_box(Draw& d) { return onto_a_box(d, true); }

/// Contact of a point with the face, an edge or a vertex of a triangle, from its front or at the start.
SetMember no_ball_onto_a_triangle(Draw& d) {
  const Vec e = d.axis(), f = d.axis(), normal = cross(e, f), corner = d.place();
  if (dot(normal, normal) == 0) return no_ball_onto_a_triangle(d);
  const std::array<Vec, 3> v{corner, corner + 4 * e, corner + 4 * f};
  const int feature = d.below(3);  // vertex, edge or face; the first of each
  const std::array<Vec, 3> weights{Vec{1, 0, 0}, Vec{0.5L, 0.5L, 0}, Vec{0.5L, 0.25L, 0.25L}};
  const Vec& w = weights[feature];
  const Vec place = w[0] * v[0] + w[1] * v[1] + w[2] * v[2], velocity = d.axis();
  Vec n = normal;
  if (feature == 1) n = d.uniform(0, 1) * cross(e, normal) + d.uniform(-1, 1) * normal;
  if (feature == 0) n = d.direction();
  n = unit(n);
  const bool outward = feature != 0 || (dot(n, e) <= 0 && dot(n, f) <= 0);
  if (!outward || dot(n, velocity) > 0 || dot(normal, velocity) >= 0) return no_ball_onto_a_triangle(d);
  const Vec start = d.below(2) == 0 ? place : place - velocity;
  return {"moving_sphere_triangle",
          Numbers{} + start + Numbers{0} + velocity + v[0] + v[1] + v[2],
          {start == place ? 0.0 : 1.0},
          {place, n},
          feature == 0 ? -1 : 1,
          unit(e),
          Numbers{} + w};
}

/// Box 2 before a face of box 1: with its own face, rotated in the plane, or with an edge.
SetMember on_a_patch(Draw& d) {
  const int about = d.below(3) - 1;
  const ExactBox box1(d, -1);
  ExactBox box2(d, about);
  for (Real& h : box2.half) h = std::min(h, std::min(box1.half[1], box1.half[2]) / 4);
  const Real depth = 0x1p-6L;
  Real reach = 0;
  for (int i = 0; i < 3; ++i) reach += std::abs(box2.along(i, box2.half[i])[0]);
  const Vec center{box1.half[0] + reach - depth, 0.125L, -0.25L};
  Vec contact = center + Vec{depth / 2, 0, 0}, way{1, 0, 0};
  for (int i = 0; i < 3; ++i) {
    Real share = box2.axes[i][0] > 0 ? -1 : 1;
    if (box2.axes[i][0] == 0) {
      share = d.below(2) == 0 ? Real(d.sign()) : d.uniform(-1, 1);
      if (std::abs(share) == 1) way = share * box2.axes[i];
    }
    contact = contact + share * box2.half[i] * box2.axes[i];
  }
  return {"box_box_penetration",
          box1.at({0, 0, 0}) + box2.at(center) + Numbers{-1},
          {double(depth), 0, 1, 0, 0},
          {contact},
          0,
          way};
}

/// Three corners on a line, or all at one point, projected along z.
SetMember weights_without_area(Draw& d) {
  const Vec base = d.place(), along = Real(d.below(3)) * d.axis();
  const std::array<Real, 3> at{0, Real(d.below(9) - 4), Real(d.below(9) - 4)};
  Vec w{d.uniform(0, 1), d.uniform(0, 1), d.uniform(0, 1)};
  w = 1 / (w[0] + w[1] + w[2]) * w;
  // A point of few bits on the line, and approximate weights of it.
  const Real wish = w[0] * at[0] + w[1] * at[1] + w[2] * at[2], share = std::round(wish * 8) / 8;
  const Real end = share < wish ? std::min({at[0], at[1], at[2]}) : std::max({at[0], at[1], at[2]});
  if (end != wish) {
    const Real part = (share - wish) / (end - wish);
    w = (1 - part) * w;
    w[std::find(at.begin(), at.end(), end) - at.begin()] += part;
  }
  const Vec off{0, 0, d.number()};
  return {"point_in_triangle",
          Numbers{} + (base + at[0] * along) + (base + at[1] * along) + (base + at[2] * along) + Vec{0, 0, 1} +
              Numbers{2} + (base + share * along + off),
          {},
          {w},
          0,
          {1, 1, 1}};
}

struct Set {
  const char* name;
  SetMember (*member)(Draw&);
};
std::ostream& operator<<(std::ostream& out, const Set& s) { return out << s.name; }

class SetOfRightAnswers : public testing::TestWithParam<Set> {
 protected:
  static constexpr int members = 64;

  /// Calls f(draw, member, scalar) for the same number of random members in each scalar.
  template <class F>
  void for_each_member(F&& f) const {
    for (const Scalar scalar : {Scalar::float64, Scalar::float32}) {
      Draw draw(scalar == Scalar::float64 ? 5 : 6);
      for (int i = 0; i < members && !HasFailure(); ++i) f(draw, GetParam().member(draw), scalar);
    }
  }
  static Exchange answer(const SetMember& m, const std::vector<Vec>& vectors, Scalar scalar) {
    Numbers numbers = m.before;
    for (const Vec& v : vectors) numbers = numbers + v;
    return asked(m.query, m.inputs, true, numbers + m.after, scalar);
  }
  static Real unit_of(const Vec& v, Scalar scalar) {
    return ulp(double(std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])})), scalar);
  }
};

TEST_P(SetOfRightAnswers, AMemberThatIsRoundedIsRight) {
  for_each_member([](Draw&, const SetMember& m, Scalar scalar) { expect_right(answer(m, m.vectors, scalar)); });
}

TEST_P(SetOfRightAnswers, AMemberThatIsPushedByAnUlpIsToldNoFurtherOff) {
  constexpr double rounded_and_pushed = 1.5;
  for_each_member([](Draw& draw, const SetMember& m, Scalar scalar) {
    std::vector<Vec> pushed = m.vectors;
    for (Vec& v : pushed) {
      const Real one = unit_of(v, scalar);
      for (Real& x : v) x = rounded(x, scalar) + (draw.below(3) - 1) * one;
    }
    expect_right(answer(m, pushed, scalar), rounded_and_pushed);
  });
}

TEST_P(SetOfRightAnswers, WhatLeavesThemIsTold) {
  constexpr Real far = 24;
  constexpr double at_least = 8;  // in each component, to cover sqrt(3) and rounding
  int asked_about = 0;
  for_each_member([&](Draw&, const SetMember& m, Scalar scalar) {
    if (m.leaving < 0) return;
    std::vector<Vec> left = m.vectors;
    Vec& v = left[std::size_t(m.leaving)];
    v = v + far * unit_of(v, scalar) * m.way;
    expect_wrong(answer(m, left, scalar), at_least);
    ++asked_about;
  });
  EXPECT_GT(asked_about, members / 2);
}

INSTANTIATE_TEST_SUITE_P(Sets, SetOfRightAnswers,
                         testing::Values(Set{"concentric", concentric}, Set{"on_the_center", on_the_center},
                                         Set{"on_the_axis", on_the_axis}, Set{"on_a_segment", on_a_segment},
                                         Set{"point_onto_a_box", point_onto_a_box},
                                         Set{"no_ball_onto_a_box", no_ball_onto_a_box},
                                         Set{"no_ball_onto_a_triangle", no_ball_onto_a_triangle},
                                         Set{"on_a_patch", on_a_patch},
                                         Set{"weights_without_area", weights_without_area}),
                         [](const auto& test) { return std::string(test.param.name); });

// A ball of radius 0 is a point, and the right answers at a contact do not depend on where the motion starts.

/// The exact finding on an answer. A set gives no distance for a right answer and for one beyond `far_off`, and any
/// other distance to one part in 128.
struct Word {
  bool yes, matches;
  double ulps;
  bool operator==(const Word& other) const {
    constexpr double share = 0x1p-7;
    const bool as_far = std::abs(ulps - other.ulps) <= share * std::max(ulps, other.ulps);
    return yes == other.yes && matches == other.matches && as_far;
  }
};
std::ostream& operator<<(std::ostream& out, const Word& w) {
  return out << (w.yes ? "yes, " : "no, ") << (w.matches ? "right, " : "wrong, ") << w.ulps << " ulps";
}
Word word_on(const Exchange& a) {
  const Enclosure e = oracle_of(*a.question.query).exact(a.question.values, a.answer, a.question.scalar, nullptr);
  constexpr double far_off = 0x1p50;
  return {e.may_be_yes, e.may_match, e.may_match && e.ulps <= 1 ? 0 : std::min(e.ulps, far_off)};
}

/// Unit vectors of small numbers, those along the axes first.
std::vector<Vec> some_normals(Draw& draw, int besides) {
  std::vector<Vec> list;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const Real side : {-1, 1}) list.emplace_back()[axis] = side;
  }
  for (int i = 0; i < besides; ++i) list.push_back(unit(draw.axis()));
  return list;
}

/// An integer point and an integer box, in half of the cases flat; the point is often on its surface.
struct PointAndBox {
  Vec point, velocity;
  Numbers box;

  explicit PointAndBox(Draw& d) {
    const auto small = [&] { return Real(d.below(7) - 3); };
    const Vec half{Real(d.below(3)), Real(d.below(3)), Real(d.below(3))};
    point = {small(), small(), small()};
    velocity = {small(), small(), small()};
    // Rotated by a right angle about an axis, so that its vertices have integer coordinates too.
    Numbers orientation{0, 0, 0, 1};
    if (d.below(2) == 0) orientation[d.below(3)] = d.sign();
    box = Numbers{0, 0, 0} + half + orientation;
  }
};

TEST(RightAnswers, OfABallOfRadiusZeroAreThoseOfItsCenter) {
  constexpr int cases = 500;
  Draw draw(7);
  int hits = 0, flat_hits = 0;
  for (int i = 0; i < cases; ++i) {
    const PointAndBox p(draw);
    const auto both = [&](bool yes, const Numbers& answer) {
      const Exchange point = asked("moving_point_box", Numbers{} + p.point + p.velocity + p.box, yes, answer);
      const Exchange ball =
          asked("moving_sphere_box", Numbers{} + p.point + Numbers{0} + p.velocity + p.box, yes, answer);
      EXPECT_EQ(word_on(point), word_on(ball)) << text(ball);
    };
    const Truth truth =
        truth_of(asked("moving_point_box", Numbers{} + p.point + p.velocity + p.box, false, {}).question);
    both(false, {});
    if (!truth.yes) continue;
    ++hits;
    flat_hits += p.box[3] == 0 || p.box[4] == 0 || p.box[5] == 0;
    Numbers contact;
    for (int k = 0; k < 4; ++k) contact.push_back(truth.alternatives[0].values[k].low);
    for (const Vec& n : some_normals(draw, 6)) both(true, contact + n);
  }
  EXPECT_GT(hits, cases / 10);
  EXPECT_GT(flat_hits, cases / 40);
}

TEST(RightAnswers, AtAContactAreTheSameWhereverThePointStarts) {
  constexpr int cases = 200;
  Draw draw(8);
  int asked_about = 0;
  for (int i = 0; i < cases; ++i) {
    const Vec corner{0, 0, 0}, e = draw.axis(), f = draw.axis(), velocity = draw.axis();
    if (dot(cross(e, f), velocity) >= 0) continue;  // along the plane it may be hit earlier
    const int on = draw.below(3);
    const Vec place = on == 0 ? corner : on == 1 ? 0.5L * e : 0.25L * (e + f);
    const auto word = [&](const Vec& start, double time, const Vec& n) {
      return word_on(asked("moving_sphere_triangle", Numbers{} + start + Numbers{0} + velocity + corner + e + f, true,
                           Numbers{time} + place + n));
    };
    std::vector<Vec> normals = some_normals(draw, 4);
    normals.push_back(unit(cross(e, f))), normals.push_back(unit(-1 * velocity));
    for (const Vec& n : normals) {
      EXPECT_EQ(word(place, 0, n), word(place - velocity, 1, n))
          << text(asked("moving_sphere_triangle", Numbers{} + place + Numbers{0} + velocity + corner + e + f, true,
                        Numbers{0} + place + n));
    }
    ++asked_about;
  }
  EXPECT_GT(asked_about, cases / 5);
}

}  // namespace
}  // namespace nearmiss
