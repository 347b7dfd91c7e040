/// What the judge says of normals of any length, of numbers at a power of two and of cases at the border of a
/// precondition; and what a right answer says of itself: its decimals, its one normal, its rule.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "corpus/generator/generator.hpp"
#include "corpus/storage/store.hpp"
#include "oracles/judge.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Case asked(std::string_view query, std::vector<double> values, Scalar scalar = Scalar::float64) {
  return {find_query(query), scalar, std::move(values), "words", 0, 0, {}};
}
Answer yes(std::vector<double> values) {
  Answer a;
  a.yes = true;
  std::copy(values.begin(), values.end(), a.values.begin());
  return a;
}
const MemberFinding* found(const Finding& f, Disagreement d) {
  const auto at = std::find_if(f.members.begin(), f.members.end(), [&](const auto& m) { return m.disagreement == d; });
  return at == f.members.end() ? nullptr : &*at;
}

// --- normals ---

const double lengths[] = {0x1p-1074,      0x1p-1060,       0x1p-1022, 2.8e-288, 1e-200, 0.25,  0.5,      0.51,
                          0.999,          1 + 0x1p-50,     1.5,       2,        1e9,    1e200, 0x1p1023, 0x1p-149,
                          0x1p-126 * 0.5, double(0x1p127f)};

/// Two unit spheres at distance 1 along x: the normal is (1, 0, 0).
Case spheres(double second = 1, Scalar scalar = Scalar::float64) {
  return asked("sphere_sphere_penetration", {0, 0, 0, 1, second, 0, 0, 1}, scalar);
}
Answer overlapping(std::vector<double> normal) { return yes({1, normal[0], normal[1], normal[2], 1, 0, 0}); }

TEST(NormalsOfAnyLength, AreComparedDividedByTheirLength) {
  for (const double length : lengths) {
    for (const Detail detail : {Detail::verdict, Detail::forward, Detail::full}) {
      const Finding f = judge(spheres(), overlapping({length, 0, 0}), {{.backward = 0, .forward = 1}}, detail);
      EXPECT_EQ(f.verdict, Verdict::agrees) << length << ", " << f.forward_ulps;
    }
    const Finding strictly = judge(spheres(), overlapping({length, 0, 0}), strict, Detail::full);
    EXPECT_EQ(found(strictly, Disagreement::wrong_normal), nullptr) << length;
    EXPECT_EQ(found(strictly, Disagreement::not_unit) != nullptr, std::abs(length - 1) > 0x1p-51) << length;
  }
}

TEST(NormalsOfAnyLength, AreWrongInAWrongDirection) {
  for (const double length : lengths) {
    for (const std::vector<double>& normal : std::vector<std::vector<double>>{{-length, 0, 0}, {0, length, 0}}) {
      const Finding f = judge(spheres(), overlapping(normal), strict, Detail::full);
      const MemberFinding* wrong = found(f, Disagreement::wrong_normal);
      ASSERT_NE(wrong, nullptr) << length;
      EXPECT_GT(wrong->backward.value().above, 0x1p40) << length;
      EXPECT_GE(wrong->forward_absolute, 0.5) << length;
      EXPECT_GT(wrong->forward_ulps, 0x1p40) << length;
    }
  }
}

/// A direction that is off by a millionth is told by that much, whatever the length.
TEST(NormalsOfAnyLength, AreOffByTheirDirection) {
  constexpr double off = 1e-6;
  for (const double length : {0x1p-1000, 1e-200, 0.25, 0.5, 0.75, 2.0, 1e9, 1e200}) {
    const Finding f = judge(spheres(), overlapping({length, off * length, 0}), strict, Detail::full);
    const MemberFinding* wrong = found(f, Disagreement::wrong_normal);
    ASSERT_NE(wrong, nullptr) << length;
    EXPECT_NEAR(wrong->forward_absolute, off, 1e-11) << length;
    EXPECT_NEAR(wrong->forward_ulps * 0x1p-52, off, 1e-11) << length;  // the exact normal has a component of 1
  }
}

TEST(NormalsOfAnyLength, AreComparedWithEveryNormalOfACone) {
  // The point starts at a vertex of the box and moves in.
  const Case corner = asked("moving_point_box", {1, 1, 1, -1, -1, -1, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1});
  for (const double length : lengths) {
    const auto with_normal = [&](double x, double y, double z) {
      return judge(corner, yes({0, 1, 1, 1, x * length, y * length, z * length}), {{.backward = 0, .forward = 1}},
                   Detail::full);
    };
    EXPECT_EQ(with_normal(1, 0, 0).verdict, Verdict::agrees) << length;
    EXPECT_EQ(with_normal(0, 1, 0).verdict, Verdict::agrees) << length;
    if (length < 1e300 && length > 1e-300) {
      EXPECT_EQ(with_normal(0.75, 0.25, 0.5).verdict, Verdict::agrees) << length;
    }
    EXPECT_NE(found(with_normal(-1, 0, 0), Disagreement::wrong_normal), nullptr) << length;
  }
}

TEST(NormalsOfAnyLength, ThatAreZeroHaveNoDirection) {
  const Finding one = judge(spheres(), overlapping({0, 0, 0}), strict, Detail::full);
  const MemberFinding* wrong = found(one, Disagreement::wrong_normal);
  ASSERT_NE(wrong, nullptr);
  EXPECT_DOUBLE_EQ(wrong->forward_absolute, 1);
  EXPECT_DOUBLE_EQ(wrong->forward_ulps, 0x1p52);
  // Any normal is right where the centers coincide; each has a component of at least 0.577.
  const Finding any = judge(spheres(0), yes({2, 0, 0, 0, 0, 0, 0}), {{.backward = 64}}, Detail::full);
  wrong = found(any, Disagreement::wrong_normal);
  ASSERT_NE(wrong, nullptr);
  EXPECT_GE(wrong->forward_absolute, 0.577);
  EXPECT_GE(wrong->forward_ulps, 0.577 * 0x1p52);
  EXPECT_GE(wrong->backward.value().above, 0x1p50);
}

/// Where only some numbers of a normal are given, it has no length.
TEST(NormalsOfAnyLength, HaveNoLengthWhereANumberIsMissing) {
  Answer partly = overlapping({1, 0, 0});
  partly.given = ~(std::uint64_t{1} << 1);  // not normal.x
  const Finding f = judge(spheres(), partly, strict, Detail::full);
  EXPECT_EQ(f.unit_error, 0);
  EXPECT_EQ(f.verdict, Verdict::agrees);
}

// --- powers of two ---

/// The nearest point is (-2, 0, -1) + t (3, 3, 1) with t near 2^-1076: x is just above -2, so that its ulp is 2^-52.
TEST(ForwardErrors, AreInTheUlpOfTheExactNumberBelowAPowerOfTwo) {
  const Case c = asked("closest_point_segment_unit", {-2, 0, -1, 1, 3, 0, -2, 5e-324, -1});
  const Answer off = yes({-1.9999999999999998, 0, -1.0000000000000004});
  const Finding f = judge(c, off, strict, Detail::full);
  EXPECT_EQ(f.verdict, Verdict::violates_contract);
  EXPECT_NEAR(f.forward_ulps, 2, 1e-12);
  EXPECT_EQ(judge(c, yes({-2, 0, -1}), strict, Detail::full).verdict, Verdict::agrees);
  EXPECT_EQ(judge(c, off, {{.forward = 1}}, Detail::forward).verdict, Verdict::violates_contract);
}

/// Two spheres whose overlap is 2 - 2^-60: off by 2 ulps downward of it, where one of 2 is twice as large.
TEST(ForwardErrors, OfADepthBelowAPowerOfTwo) {
  const double unit = 0x1p-52;
  const Case below = asked("sphere_sphere_penetration", {0, 0, 0, 1, 0x1p-60, 0, 0, 1});
  const auto depth = [&](const Case& c, double d) {
    Answer a = yes({d, 0, 0, 0, 0, 0, 0});
    a.given = 1;
    return judge(c, a, strict, Detail::full).forward_ulps;
  };
  EXPECT_NEAR(depth(below, 2 - 2 * unit), 2, 0.01);
  EXPECT_NEAR(depth(below, 2), 0x1p-60 / (2 * unit), 1e-6) << "the given number is 2, and its ulp is the larger one";
  const Case at = asked("sphere_sphere_penetration", {0, 0, 0, 1, 0, 0, 0, 1});
  EXPECT_EQ(depth(at, 2 - 2 * unit), 1) << "the exact number is 2";
}

TEST(ForwardErrors, OfATimeInFloatBelowAPowerOfTwo) {
  // The time is (2 - 2^-40) / 1, the plane z = 0.
  const float unit = 0x1p-23f;
  const Case c = asked("moving_point_plane", {0, 0, 0x1p24, 0, 0, -0x1p23 - 1, 0, 0, 1, 0}, Scalar::float32);
  // 2^24 / (2^23 + 1) = 2 - 2^-22 + ...: between two floats below 2.
  Answer a = yes({2 - 3 * unit, 0, 0, 0, 0, 0, 0});
  a.given = 1;
  EXPECT_NEAR(judge(c, a, strict, Detail::full).forward_ulps, 1, 0.01);
}

/// For every query, against the definition: whatever the answer is moved by, its distance is at least that in the ulp
/// of the larger number, given or exact, and never one in the next smaller ulp.
TEST(ForwardErrors, OfMembersOfOneNumberAreThoseOfTheDefinition) {
  for (const Query& q : catalogue()) {
    for (std::uint64_t i = 0; i < 60; ++i) {
      for (const Scalar scalar : scalars) {
        const Case c = generate(q, scalar, 7, i);
        const Truth truth = truth_of(c);
        if (truth.alternatives.size() != 1) continue;
        const Alternative& right = truth.alternatives.front();
        for (const Layout::Part& part : q.layout.parts) {
          if (part.end - part.begin != 1 || part.end > right.count || part.role == Role::flag) continue;
          const Bounds& exact = right.values[part.begin];
          const double size = std::abs(exact.low);
          if (exact.low != exact.high || size < 0x1p-1000 || size > largest_finite(scalar) / 2) continue;
          for (const double steps : {-3.0, -2.0, 2.0, 3.0}) {
            Answer a;
            a.yes = truth.yes;
            a.given = std::uint64_t{1} << part.begin;
            const double x = exact.low + steps * ulp(exact.low, scalar);
            a.values[part.begin] = scalar == Scalar::float32 ? double(float(x)) : x;
            const double given = a.values[part.begin], apart = std::abs(given - exact.low);
            const double expected = apart / ulp(std::max(std::abs(given), std::abs(exact.low)), scalar);
            const Finding f = judge(c, a, {{.forward = 0}}, Detail::full);
            EXPECT_NEAR(f.forward_ulps, expected, 1e-9) << q.name << " " << i << " " << given << " " << exact.low;
          }
        }
      }
    }
  }
}

// --- borders of preconditions ---

const Standard outside{{.backward = 8, .forward = 8}, true, {Precondition::starts_outside}};

/// The judgement of a hit at the start, by a library that counts a start in touch as a hit.
Finding hit_at_start(const Case& c, const Standard& standard, std::vector<double> normal = {1, 0, 0}) {
  Answer a = yes({});
  a.values[c.query->layout.at(Role::time)->begin] = 0;
  const std::size_t place = c.query->layout.at(Role::position)->begin;
  std::copy(c.values.begin(), c.values.begin() + 3, &a.values[place]);
  std::copy(normal.begin(), normal.end(), &a.values[c.query->layout.at(Role::normal)->begin]);
  return judge(c, a, standard, Detail::full);
}

/// The point moves away from the face x = 1 of a box, from a start at x, and along x.
Case leaving_box(double x, double speed = 1) {
  return asked("moving_point_box", {x, 0, 0, speed, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1});
}
Case leaving_plane(double z, double speed) { return asked("moving_point_plane", {1, 0, z, 1, 0, speed, 0, 0, 1, 0}); }

TEST(BordersOfPreconditions, EndTheLadder) {
  const double next = std::nextafter(1.0, 2.0);
  const std::vector<Case> at_the_border{
      leaving_box(next),
      asked("moving_point_sphere", {next, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1}),
      asked("moving_point_capsule", {next, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 1, 1}),
      asked("moving_point_aabox", {next, 0, 0, 1, 0, 0, -1, -1, -1, 1, 1, 1}),
      leaving_plane(5e-17, 1),
      leaving_plane(5e-17, 1e-17),
      asked("moving_point_triangle", {1, 1, 5e-17, 0, 0, 1, 0, 0, 0, 4, 0, 0, 0, 4, 0}),
      asked("moving_point_rectangle", {1, 1, 5e-17, 0, 0, 1, 0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0}),
      asked("moving_sphere_plane", {0, 0, next, 1, 1, 0, 1, 0, 0, 1, 0}),  // the plane has two sides
      asked("moving_sphere_plane", {0, 0, next, 1, 1, 0, 1e-17, 0, 0, 1, 0}),
  };
  for (const Case& c : at_the_border) {
    const Finding anywhere = hit_at_start(c, {{.backward = 8, .forward = 8}});
    const Finding outside_only = hit_at_start(c, outside);
    EXPECT_EQ(outside_only.disagreement, Disagreement::false_hit) << c.query->name;
    EXPECT_EQ(outside_only.verdict, Verdict::not_proved) << c.query->name;
    EXPECT_LE(outside_only.backward.value().above, 1) << c.query->name;
    if (outside_only.backward->above < anywhere.backward->above) {
      EXPECT_TRUE(outside_only.ended_by.has(Precondition::starts_outside)) << c.query->name;
    }
    // A promise of exact decisions holds for every case that meets the precondition.
    EXPECT_EQ(hit_at_start(c, {strict, true, {Precondition::starts_outside}}).verdict, Verdict::violates_contract);
  }
  EXPECT_GT(hit_at_start(at_the_border.front(), {{.backward = 8}}).backward.value().above, 0x1p40)
      << "without the precondition it is a finding";
}

/// Further away, the ladder goes as far as every input meets the precondition.
TEST(BordersOfPreconditions, LeaveTheFindingsOfOtherCases) {
  for (const int k : {4, 12, 20, 30, 44}) {
    const double gap = std::ldexp(1.0, k - 52);
    const Finding f = hit_at_start(leaving_box(1 + gap), outside);
    EXPECT_EQ(f.disagreement, Disagreement::false_hit);
    EXPECT_EQ(f.verdict, k > 4 ? Verdict::violates_contract : Verdict::not_proved) << k;
    EXPECT_GE(f.backward.value().above, std::ldexp(1.0, std::max(0, k - 4))) << k;
    EXPECT_LE(f.backward.value().above, std::ldexp(1.0, k + 2)) << k;
  }
  // A precondition that does not concern the query, or that has no border, ends nothing.
  const Case turned = asked("moving_point_box", {3, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1});
  const double of_all = hit_at_start(turned, {{.backward = 8}}).backward.value().above;
  for (const Precondition p : {Precondition::unit_quaternion, Precondition::true_rectangle}) {
    const Finding f = hit_at_start(turned, {{.backward = 8}, true, {p}});
    EXPECT_EQ(f.backward.value().above, of_all);
    EXPECT_TRUE(f.ended_by.empty());
  }
}

TEST(BordersOfPreconditions, AreThoseOfSizesAndMotionsToo) {
  const Answer apart = [] {
    Answer a;
    a.values[0] = -1;
    return a;
  }();
  const auto bound = [&](double radius, Preconditions required) {
    const Case c = asked("sphere_sphere_penetration", {0, 0, 0, radius, 0.5, 0, 0, 1});
    return judge(c, apart, {{.backward = 8}, true, required}, Detail::full).backward.value().above;
  };
  EXPECT_GT(bound(0x1p-50, {}), 0x1p40);
  EXPECT_LE(bound(0x1p-50, {Precondition::no_zero_sizes}), 8);
  EXPECT_GT(bound(0.25, {Precondition::no_zero_sizes}), 0x1p40);
  const Case still = asked("moving_sphere_sphere", {-3, 0, 0, 1, 0x1p-40, 0, 0, 0, 0, 0, 1}, Scalar::float32);
  Answer miss;
  miss.values[0] = infinity;
  const Finding f = judge(still, miss, {{.backward = 8}, true, {Precondition::moves}}, Detail::full);
  EXPECT_LT(f.backward.value().above, 0x1p24) << "beyond, the velocity may be zero";
  EXPECT_GT(f.backward.value().above, 0x1p18);
}

TEST(BordersOfPreconditions, EndTheFinerBoundToo) {
  const Case c = leaving_box(std::nextafter(1.0, 2.0));
  Answer a = yes({0, c.values[0], 0, 0, 1, 0, 0});
  EXPECT_GT(finer_backward(c, a, {0x1p40}), 0x1p40);
  EXPECT_EQ(finer_backward(c, a, {1}, {Precondition::starts_outside}), 1);
}

// --- decimals ---

std::string depth_of(const Case& c) { return truth_of(c).alternatives.front().decimals.front(); }

TEST(Decimals, LetTheNearestNumberOfTheScalarBeRead) {
  const auto gap = [](double a, double b) {
    return depth_of(asked("sphere_plane_penetration", {0, 0, a, b, 0, 0, 1, 0}));
  };
  EXPECT_EQ(gap(0, 0.1), "0.1");
  EXPECT_EQ(gap(0, 0.30000000000000004), "0.30000000000000004");
  EXPECT_EQ(gap(-0.1, 0.2), "≈0.30000000000000004") << "0.3000000000000000166 is nearer to it than to 0.3";
  EXPECT_EQ(gap(-0x1p-1074, 1), "≈1");
  EXPECT_EQ(gap(0.25, 0.75), "0.5");
  EXPECT_EQ(gap(3, 1), "-2");
  const auto time = [](double way, double speed, Scalar scalar) {
    const Case c = asked("moving_point_plane", {0, 0, way, 0, 0, -speed, 0, 0, 1, 0}, scalar);
    return truth_of(c).alternatives.front().decimals.front();
  };
  EXPECT_EQ(time(1, 3, Scalar::float64), "≈0.3333333333333333");
  EXPECT_EQ(time(1, 3, Scalar::float32), "≈0.3333333333333333");
  EXPECT_EQ(time(1, 10, Scalar::float64), "0.1") << "a tenth, whose decimal is exact";
  EXPECT_EQ(time(1, 10, Scalar::float32), "0.1");
  EXPECT_EQ(time(double(0.1f), 1, Scalar::float32), "0.1") << "a float is shown as such";
  EXPECT_EQ(time(1e-300, 1e300, Scalar::float64), "≈0");
  // Halfway between two floats, but for 2^-60: the digits of the nearest double alone would mislead.
  EXPECT_EQ(time(0x1p60, 0x1p60 - 0x1p36, Scalar::float32).substr(0, 3), "≈");
}

/// What is read from a decimal is the nearest number, of every number of every query.
TEST(Decimals, AreReadAsTheNearestNumberEverywhere) {
  int numbers = 0, cut = 0;
  for (const Query& q : catalogue()) {
    for (std::uint64_t i = 0; i < 40; ++i) {
      const Scalar scalar = scalars[i % 2];
      const Case c = generate(q, scalar, 11, i);
      for (const Alternative& a : truth_of(c).alternatives) {
        ASSERT_EQ(a.decimals.size(), a.count);
        ASSERT_EQ(a.nearest.size(), a.count);
        for (std::size_t k = 0; k < a.count; ++k) {
          if (a.many_normals && q.outputs[k].role == Role::normal) continue;
          const bool is_cut = a.decimals[k].starts_with("≈");
          const std::string text = is_cut ? a.decimals[k].substr(std::string("≈").size()) : a.decimals[k];
          const double read = scalar == Scalar::float32 ? double(std::strtof(text.c_str(), nullptr))
                                                        : std::strtod(text.c_str(), nullptr);
          if (text.find_first_of("<>") == std::string::npos) {
            ASSERT_EQ(read, a.nearest[k]) << q.name << " " << text;
          }
          const Bounds& b = a.values[k];
          if (b.low == b.high && representable(b.low, scalar)) {
            ASSERT_EQ(a.nearest[k], b.low) << q.name;
            ASSERT_FALSE(is_cut) << q.name << " " << text;
          }
          if (a.nearest[k] != b.low &&
              a.nearest[k] != b.high) {  // an infinity is a bound of a number beyond all doubles
            ASSERT_LE(std::abs(a.nearest[k] - b.low), ulp(b.low, scalar)) << q.name;
          }
          ++numbers, cut += is_cut;
        }
      }
    }
  }
  EXPECT_GT(numbers, 5'000);
  EXPECT_GT(cut, numbers / 10);
}

// --- one normal ---

TEST(RightNormals, OfAConeThatIsOneDirectionAreThatDirection) {
  const auto normals = [](const Case& c) {
    std::vector<std::string> all;
    const std::size_t normal = c.query->layout.at(Role::normal)->begin;
    for (const Alternative& a : truth_of(c).alternatives) {
      all.push_back(a.many_normals
                        ? "many"
                        : fmt::format("{} {} {}", a.decimals[normal], a.decimals[normal + 1], a.decimals[normal + 2]));
    }
    return all;
  };
  using All = std::vector<std::string>;
  const auto box = [](std::vector<double> values, const std::vector<double>& velocity, const std::vector<double>& half,
                      const std::vector<double>& turned = {0, 0, 0, 1}) {
    values.insert(values.end(), velocity.begin(), velocity.end());
    values.insert(values.end(), {0, 0, 0});
    values.insert(values.end(), half.begin(), half.end());
    values.insert(values.end(), turned.begin(), turned.end());
    return asked("moving_point_box", std::move(values));
  };
  EXPECT_EQ(normals(box({3, 0.5, 0}, {-1, 0, 0}, {1, 1, 1})), All{"1 0 0"});
  EXPECT_EQ(normals(box({0, -3, 0}, {0, 1, 0}, {1, 1, 1})), All{"0 -1 0"});
  EXPECT_EQ(normals(box({3, 0, 0}, {-1, 0, 0}, {1, 1, 1}, {0, 0, 1, 3})), All{"0.8 0.6 0"}) << "not a multiple of 1/2";
  EXPECT_EQ(normals(box({3, 1, 0}, {-1, 0, 0}, {1, 1, 1})), All{"many"}) << "an edge";
  EXPECT_EQ(normals(box({0, 0, 3}, {0, 0, -1}, {1, 1, 0})), All{"0 0 1"}) << "a flat box, met from one side";
}

// --- rules ---

struct Ruled {
  const char* name;
  Case question;
  std::string because;
};

TEST(RulesOfNo, AreToldOfEachQuery) {
  const double r = std::sqrt(0.5);
  const std::vector<double> up{0, 0, 0, 4, 0, 0, 0, 4, 0}, square{0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0};
  const auto joined = [](std::vector<double> a, const std::vector<double>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  const auto back = [](std::string one, std::string other) {
    return fmt::format("the {} moves from the back of the {} to its front, and only the front can be hit", one, other);
  };
  const std::string away = " and moves away", late = "the contact comes at a time beyond the largest number";
  std::vector<Ruled> all{
      {"triangle from its back", asked("moving_point_triangle", joined({1, 1, -1, 0, 0, 1}, up)),
       back("point", "triangle")},
      {"the same prepared", asked("moving_point_triangle_prepared", joined({1, 1, -1, 0, 0, 1}, up)),
       back("point", "triangle")},
      {"beside the triangle", asked("moving_point_triangle", joined({9, 9, -1, 0, 0, 1}, up)), ""},
      {"away in front", asked("moving_point_triangle", joined({1, 1, 1, 0, 0, 1}, up)), ""},
      {"along the triangle", asked("moving_point_triangle", joined({-1, 1, 0, 1, 0, 0}, up)),
       "the point does not move toward the front of the triangle"},
      {"no area", asked("moving_point_triangle", {1, 0, 1, 0, 0, -1, 0, 0, 0, 4, 0, 0, 2, 0, 0}),
       "the triangle has no area"},
      {"rectangle from its back", asked("moving_point_rectangle", joined({1, 3, -1, 0, 0, 1}, square)),
       back("point", "rectangle")},
      {"plane from its back", asked("moving_point_plane", {0, 0, -1, 0, 0, 1, 0, 0, 1, 0}), back("point", "plane")},
      {"along the plane", asked("moving_point_plane", {0, 0, 0, 1, 0, 0, 0, 0, 1, 0}),
       "the point does not move toward the front of the plane"},
      {"above the plane", asked("moving_point_plane", {0, 0, 1, 1, 0, 0, 0, 0, 1, 0}), ""},
      {"inside the box", asked("moving_point_box", {0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1}),
       "the point starts inside the box"},
      {"leaving the box", leaving_box(1), "the point starts in touch with the box" + away},
      {"far from the box", leaving_box(2), ""},
      {"inside the capsule", asked("moving_point_capsule", {0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 1, 1}),
       "the point starts inside the capsule"},
      {"leaving the capsule", asked("moving_point_capsule", {1, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 1, 1}),
       "the point starts in touch with the capsule" + away},
      {"in the aligned box", asked("moving_point_aabox", {0, 0, 0, 1, 0, 0, -1, -1, -1, 1, 1, 1}),
       "the point starts in the axis-aligned box"},
      {"at rest in a hollow sphere", asked("moving_point_sphere", {0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0}),
       "the point does not move, and so never leaves the sphere"},
      {"at rest outside", asked("moving_point_sphere", {3, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0}), ""},
      {"sphere from the back of a plane", asked("moving_sphere_plane", {0, 0, 0.5, 1, 0, 0, 1, 0, 0, 1, 0}),
       back("sphere", "plane")},
      {"sphere from the back of a triangle", asked("moving_sphere_triangle", joined({1, 1, -3, 1, 0, 0, 1}, up)),
       back("sphere", "triangle")},
      {"sphere that leaves a triangle", asked("moving_sphere_triangle", joined({1, 1, 1, 1, 0, 0, 1}, up)),
       "the sphere starts in touch with the triangle" + away},
      {"sphere from the back of a rectangle", asked("moving_sphere_rectangle", joined({1, 1, -3, 1, 0, 0, 1}, square)),
       back("sphere", "rectangle")},
      {"sphere that leaves a box", asked("moving_sphere_box", {3, 0, 0, 2, 1, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1}),
       "the sphere starts in touch with the box" + away},
      {"ball of radius 0 in a box", asked("moving_sphere_box", {0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1}),
       "the sphere starts inside the box"},
      {"sphere that leaves a capsule", asked("moving_sphere_capsule", {3, 0, 0, 2, 1, 0, 0, 0, 0, -1, 0, 0, 1, 1}),
       "the sphere starts in touch with the capsule" + away},
      {"sphere that leaves a sphere", asked("moving_sphere_sphere", {3, 0, 0, 2, 1, 0, 0, 0, 0, 0, 1}),
       "the sphere starts in touch with the fixed sphere" + away},
      {"after the limit", asked("moving_sphere_passes_box", {9, 0, 0, 1, -1, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 2, 0}),
       "the contact comes after the limit of time"},
      {"never", asked("moving_sphere_passes_box", {9, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 2, 0}), ""},
      {"late", asked("moving_point_plane", {0, 0, 1e200, 0, 0, -1e-200, 0, 0, 1, 0}), late},
      {"late to an aligned box", asked("moving_point_aabox", {1e200, 0, 0, -1e-200, 0, 0, -1, -1, -1, 1, 1, 1}), late},
      {"late in float", asked("moving_point_plane", {0, 0, 0x1p100, 0, 0, -0x1p-100, 0, 0, 1, 0}, Scalar::float32),
       late},
      {"late sphere", asked("moving_sphere_sphere", {1e200, 0, 0, 1, -1e-200, 0, 0, 0, 0, 0, 1}), late},
      {"apart", asked("sphere_sphere_overlap", {0, 0, 0, 1, 3, 0, 0, 1}), ""},
      {"a hit", asked("moving_point_plane", {0, 0, 1, 0, 0, -1, 0, 0, 1, 0}), ""},
      {"askew", asked("moving_point_triangle", joined({1, 1, -1, r, r, 1}, up)), back("point", "triangle")},
  };
  for (const Ruled& ruled : all) EXPECT_EQ(truth_of(ruled.question).because, ruled.because) << ruled.name;
}

/// Touching shapes whose difference has no volume always have a normal that the motion does not point against, so that
/// no motion leaves.
bool can_leave(const Query& query) {
  int dimensions = 0;
  for (const Operand& o : generate(query, Scalar::float64, 13, 0).operands().all) {
    const bool is_flat = o.shape == Shape::triangle || o.shape == Shape::rectangle;
    dimensions += o.shape == Shape::point ? 0 : o.shape == Shape::segment ? 1 : is_flat ? 2 : 3;
  }
  return query.traits.one_sided || dimensions >= 3;
}

/// A rule is told of a no alone, and the case is a yes without it: of generated and stored cases, some have each kind
/// of rule.
TEST(RulesOfNo, AreToldOfNoYesAndOfSomeOfMostMotions) {
  for (const Query& q : catalogue()) {
    int told = 0;
    const auto look_at = [&](const Case& c) {
      const Truth t = truth_of(c);
      if (t.yes) {
        EXPECT_EQ(t.because, "") << q.name;
      }
      told += !t.because.empty();
    };
    for (std::uint64_t i = 0; i < 600; ++i) look_at(generate(q, scalars[i % 2], 13, i));
    for (const StoredCase& s : stored_cases(q)) look_at(s.question);
    if (q.kind != Kind::decision) {
      EXPECT_EQ(told > 0, q.kind == Kind::impact && can_leave(q)) << q.name;
    }
  }
}

}  // namespace
}  // namespace nearmiss
