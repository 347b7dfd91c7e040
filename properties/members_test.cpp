/// Each member of an answer is judged alone, against the nearest right answer, in the ulps that the documentation
/// defines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "oracles/judge.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Case asked(const char* query, std::vector<double> values) {
  return {find_query(query), Scalar::float64, std::move(values), "members", 0, 0, {}};
}
Answer yes(std::vector<double> values) {
  Answer a;
  a.yes = true;
  std::copy(values.begin(), values.end(), a.values.begin());
  return a;
}
/// A ball of radius 1 that moves along x from -10 with speed 2, toward the unit box around (0, y, 0).
Case flight(double y) { return asked("moving_sphere_box", {-10, 0, 0, 1, 2, 0, 0, 0, y, 0, 1, 1, 1, 0, 0, 0, 1}); }
const MemberFinding* found(const Finding& f, Disagreement d) {
  const auto at = std::find_if(f.members.begin(), f.members.end(), [&](const auto& m) { return m.disagreement == d; });
  return at == f.members.end() ? nullptr : &*at;
}
std::string name_of_headline(const Finding& f) { return std::string(name_of(f.disagreement)); }

TEST(Members, AreAllToldWhateverTheOthersAre) {
  const Finding f = judge(flight(0), yes({4.5, -1, 0.25, 0, 0, 1, 0}), strict, Detail::full);
  ASSERT_EQ(f.members.size(), 3u);
  for (const Disagreement d : {Disagreement::wrong_time, Disagreement::wrong_place, Disagreement::wrong_normal}) {
    const MemberFinding* m = found(f, d);
    ASSERT_NE(m, nullptr) << name_of(d);
    EXPECT_TRUE(m->breaks()) << name_of(d);
    EXPECT_GT(m->backward.value().above, 0x1p40) << name_of(d);
  }
  EXPECT_EQ(found(f, Disagreement::wrong_time)->forward_absolute, 0.5);
  EXPECT_EQ(found(f, Disagreement::wrong_place)->forward_absolute, 0.25);
}

TEST(Members, BesideAKnifesEdgeAreWhatIsWrong) {
  // The ball misses the box by an ulp: a nearby input has a yes, but none has a contact near x = 7.
  const Case c = flight(std::nextafter(2.0, 3.0));
  const Finding f = judge(c, yes({5, 7, 1, 0, 0, -1, 0}), {{.backward = 16}}, Detail::full);
  const MemberFinding* decision = found(f, Disagreement::false_hit);
  ASSERT_NE(decision, nullptr);
  EXPECT_LE(decision->backward.value().above, 1);
  EXPECT_FALSE(decision->breaks());
  EXPECT_EQ(name_of_headline(f), "off the surface");
  EXPECT_GT(f.headline_member()->backward.value().above, 0x1p40);
  EXPECT_EQ(f.verdict, Verdict::violates_contract);
}

TEST(Members, BesideAGrossDecisionAreNotCounted) {
  const Finding f = judge(flight(5), yes({4, -1, 0, 0, -1, 0, 0}), strict, Detail::full);
  ASSERT_EQ(f.members.size(), 1u);
  EXPECT_EQ(name_of_headline(f), "false hit");
}

TEST(Members, ATimeBeforeTheStartIsAKindOfItsOwn) {
  // The ball overlaps the box from the start: time 0.
  const Case c = asked("moving_sphere_box", {-1.5, 0, 0, 1, 2, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1});
  const Finding f = judge(c, yes({-1.5e-8, -1, 0, 0, -1, 0, 0}), strict, Detail::full);
  EXPECT_EQ(name_of_headline(f), "negative time");
  EXPECT_EQ(f.members.size(), 1u);
  EXPECT_EQ(f.headline_member()->forward_absolute, 1.5e-8);
}

TEST(Members, OfDifferentTiesAreNoRightAnswerTogether) {
  // The center of a cube: out through any face, with the contact on that side.
  const Case c = asked("sphere_box_penetration", {0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1});
  EXPECT_EQ(judge(c, yes({2, 1, 0, 0, 1, 0, 0}), strict, Detail::full).verdict, Verdict::agrees);
  EXPECT_EQ(judge(c, yes({2, 0, -1, 0, 0, -1, 0}), strict, Detail::full).verdict, Verdict::agrees);
  const Finding f = judge(c, yes({2, 1, 0, 0, 0, 1, 0}), strict, Detail::full);
  EXPECT_EQ(f.verdict, Verdict::violates_contract);
  EXPECT_EQ(name_of_headline(f), "wrong combination");
  EXPECT_TRUE(f.members.empty());
}

TEST(Members, ThatAreNotFiniteHideNoOthers) {
  const Finding f = judge(flight(0), yes({4.5, -1, NAN, 0, -1, 0, 0}), strict, Detail::full);
  EXPECT_EQ(name_of_headline(f), "not finite");
  EXPECT_NE(found(f, Disagreement::wrong_time), nullptr);
}

TEST(Members, ANormalsLengthAndDirectionAreTwo) {
  const Finding f = judge(flight(0), yes({4, -1, 0, 0, 0, 1.25, 0}), strict, Detail::full);
  EXPECT_NE(found(f, Disagreement::not_unit), nullptr);
  EXPECT_NE(found(f, Disagreement::wrong_normal), nullptr);
  const Finding length = judge(flight(0), yes({4, -1, 0, 0, -1.25, 0, 0}), strict, Detail::full);
  EXPECT_EQ(length.members.size(), 1u);
  EXPECT_EQ(name_of_headline(length), "not unit");
}

/// Among several right answers the nearest counts, even if another one shares more numbers with the given answer.
TEST(NearestAnswer, IsNotTheOneWithTheFewestMismatches) {
  const Case c = asked("sphere_box_penetration", {0, 0, 0, 0, 0, 0, 0, 1, 1, 2, -1, 1.0000000000000007, 0, 0.5});
  const Truth t = truth_of(c);
  ASSERT_EQ(t.alternatives.size(), 4u);
  int coincidences = 0;
  for (const Alternative& a : t.alternatives) {
    Answer given = yes({});
    for (std::size_t i = 0; i < a.count; ++i) given.values[i] = a.values[i].low;
    for (const Alternative& b : t.alternatives) {
      for (std::size_t i = 1; i < 4; ++i) {  // one component of the normal from another alternative
        const double off = std::abs(b.values[i].low - given.values[i]) / 0x1p-53;
        if (!(off > 1 && off < 16)) continue;
        ++coincidences;
        Answer near = given;
        near.values[i] = b.values[i].low;
        EXPECT_LE(judge(c, near, strict, Detail::full).forward_ulps, off + 1);
      }
    }
  }
  EXPECT_GT(coincidences, 0);
}

/// Distances are in ulps of the normal's largest component: 10 ulps across the normal count as 10, not as 20.
TEST(NormalError, IsToldInUlps) {
  const Case c = asked("sphere_plane_penetration", {0, 0, 0, 1, 3, 4, 0, 0});
  const double ulp_of_largest = 0x1p-53;
  for (const double pushed : {0.0, 2.0, 5.0, 8.0, 80.0}) {
    const double across = pushed * ulp_of_largest;
    const Finding f = judge(c, yes({1, 0.6 - across, 0.8 + 0.75 * across, 0, -0.6, -0.8, 0}), {}, Detail::full);
    const MemberFinding* m = found(f, Disagreement::wrong_normal);
    EXPECT_EQ(m != nullptr, pushed > 1) << pushed;
    if (m == nullptr) continue;
    EXPECT_LE(m->forward_ulps, pushed + 0.5);  // 0.6 and 0.8 are rounded
    EXPECT_GE(m->forward_ulps, pushed - 0.5 - 0.01 * pushed);
  }
}

/// A longer normal in the right direction is wrong in length alone. If the distance as given is shorter, it counts.
TEST(NormalError, IsTheLesserOfNumbersAndDirection) {
  const Case c = asked("sphere_plane_penetration", {0, 0, 0, 1, 3, 4, 0, 0});
  const Finding longer = judge(c, yes({1, 0.6 * 1.25, 0.8 * 1.25, 0, -0.6, -0.8, 0}), {}, Detail::full);
  EXPECT_LE(longer.forward_ulps, 1);
  const Finding as_given = judge(c, yes({1, 0.6 + 0x1p-53, 0.8 - 0x1p-53, 0, -0.6, -0.8, 0}), {}, Detail::full);
  EXPECT_LE(as_given.forward_ulps, 1.5);
}

/// A cone's directions have up to three components: a normal with an error of one ulp in each component has distance
/// one.
TEST(NormalError, OfAConeIsOneOfComponents) {
  // A point on the edge of a box rotated about (1, 2, 3): the normals there are perpendicular to the edge.
  const Case c = asked("moving_point_box", {0, 1, 1, 0, -1, -1, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1});
  const double d = 0x1p-50;  // 4 ulps of 0.70710678
  const Finding f = judge(c, yes({0, 0, 1, 1, d, 0.70710678118654757, 0.70710678118654757}), {}, Detail::full);
  EXPECT_LE(f.forward_ulps, 8 + 0.5);
  EXPECT_GE(f.forward_ulps, 8 - 0.5);
}

// What a scene requires, in its lengths and times, in place of a share of the coordinates.

/// The measure, for subjects that promise nothing.
const Standard by_measure{
    {.backward = 1e-4 / unit_roundoff(Scalar::float64), .unit = 1e-4 / unit_roundoff(Scalar::float64)}, false};
const SceneLimits world{"world", "yard", 0.01, 0.02, 0.001};
/// A ball of radius 1 that flies at a wall, 17,000 yards from the origin; exactly it hits at time 2, at x = 17004.
Case far_flight() {
  return asked("moving_sphere_box", {17000, 0, 0, 1, 1.5, 0, 0, 17005, 0, 0, 1, 40, 40, 0, 0, 0, 1});
}
Answer far_hit(double time, double x) { return yes({time, x, 0, 0, -1, 0, 0}); }

TEST(SceneLimits, BoundPlacesAndTimesByLengthsAndSeconds) {
  const auto judged = [](double time, double x, Detail detail) {
    return judge(far_flight(), far_hit(time, x), by_measure, detail, &world);
  };
  for (const Detail detail : {Detail::verdict, Detail::full}) {
    EXPECT_FALSE(judged(2, 17004, detail).is_proved());
    EXPECT_FALSE(judged(2.0009, 17004.009, detail).is_proved());
    const Finding place = judged(2, 17004.011, detail), time = judged(2.0011, 17004, detail);
    EXPECT_EQ(place.verdict, Verdict::exceeds_measure);
    EXPECT_EQ(place.broken, Clause::scene);
    EXPECT_EQ(place.clause, "the scene world requires places and depths within 0.01 yard");
    EXPECT_EQ(time.clause, "the scene world requires times of impact within 0.001 s");
  }
  EXPECT_FALSE(judge(far_flight(), far_hit(2, 17004.5), by_measure, Detail::full, nullptr).is_proved())
      << "1e-4 of 17,000";
  const Standard promise{by_measure.contract, true};
  EXPECT_FALSE(judge(far_flight(), far_hit(2, 17004.5), promise, Detail::full, &world).is_proved())
      << "a promise stays";
}

TEST(SceneLimits, BoundDecisionsByDepthAndGap) {
  const auto overlap = [](double depth, bool says) {
    const Case c = asked("sphere_sphere_overlap", {17000, 0, 0, 1, 17002 - depth, 0, 0, 1});
    Answer a = yes({});
    a.yes = says;
    return judge(c, a, by_measure, Detail::full, &world);
  };
  EXPECT_FALSE(overlap(0.019, false).is_proved());
  EXPECT_TRUE(overlap(0.1, false).is_proved());
  EXPECT_EQ(overlap(0.1, false).clause, "the scene world requires missed contacts to be at most 0.02 yard deep");
  EXPECT_FALSE(overlap(-0.009, true).is_proved());
  EXPECT_TRUE(overlap(-0.05, true).is_proved());
  EXPECT_EQ(overlap(-0.05, true).clause, "the scene world requires phantom contacts to be at most 0.01 yard apart");
}

/// A depth that no balls have, 0.004 beyond both diameters, is within what the scene tolerates.
TEST(SceneLimits, TolerateAMemberInTheWholeAnswerToo) {
  const Case c = asked("sphere_sphere_penetration", {17000, 0, 0, 0.5, 17000.001, 0, 0, 0.5});
  Answer a = yes({1.003});
  a.given = 1;
  EXPECT_FALSE(judge(c, a, by_measure, Detail::full, &world).is_proved());
  a.values[0] = 1.02;
  EXPECT_EQ(judge(c, a, by_measure, Detail::full, &world).broken, Clause::scene);
}

/// A scene states nothing about them.
TEST(SceneLimits, LeaveNormalsToTheMeasure) {
  Answer turned = far_hit(2, 17004);
  turned.values[4] = -std::cos(1e-5), turned.values[5] = std::sin(1e-5);
  EXPECT_FALSE(judge(far_flight(), turned, by_measure, Detail::full, &world).is_proved());
  turned.values[4] = -std::cos(0.1), turned.values[5] = std::sin(0.1);
  const Finding f = judge(far_flight(), turned, by_measure, Detail::full, &world);
  EXPECT_EQ(f.broken, Clause::backward);
  EXPECT_EQ(f.disagreement, Disagreement::wrong_normal);
}

/// An unbounded enclosure allows every nearby finite number, but an infinite number is wrong here.
TEST(InfiniteNumbers, AreNoneWhereTheExactOneIsOrdinary) {
  const Case c = asked("sphere_sphere_penetration", {-1e200, 0, 0, 1, 1e200, 0, 0, 1});
  Answer apart = yes({-infinity, 0, 0, 0, 0, 0, 0});
  apart.yes = false;
  for (const double allowed : {4.0, 1e4, 1e9}) {
    const Finding f = judge(c, apart, {{.backward = allowed}, false}, Detail::verdict);
    EXPECT_EQ(f.verdict, Verdict::exceeds_measure) << allowed;
    EXPECT_EQ(name_of_headline(f), "not finite") << allowed;
  }
}

}  // namespace
}  // namespace nearmiss
