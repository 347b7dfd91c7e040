/// What a subject declares is the meaning by which the judge holds it to account: exactly, in both directions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "corpus/generator/fit.hpp"
#include "oracles/confirmed.hpp"
#include "oracles/declared_oracle.hpp"
#include "oracles/requirements.hpp"
#include "oracles/seen_from_behind.hpp"
#include "oracles/touch.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Case asked(std::string_view query, std::vector<double> values, Scalar scalar = Scalar::float64) {
  return {find_query(query), scalar, std::move(values), "declared", 0, 0, {}};
}
Answer hit(std::vector<double> values) {
  Answer a;
  a.yes = true;
  std::copy(values.begin(), values.end(), a.values.begin());
  return a;
}
Answer miss() {
  Answer a;
  a.given = 0;
  a.values[0] = infinity;
  return a;
}
Disagreement fault(const Case& c, const Answer& a, Conventions declared) {
  const Finding f = confirmed(c, a, {strict, true, {}, declared}, Detail::verdict);
  return f.is_proved() ? f.disagreement : Disagreement::none;
}

constexpr Disagreement right = Disagreement::none;
constexpr Conventions none{}, two_sided{Convention::two_sided};

/// A point that meets the triangle in z = 0 from below, at time 1.
const Case from_behind = asked("moving_point_triangle", {1, 1, -2, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 4, 0});
const Answer at_the_back = hit({1, 1, 1, 0, 0, 0, -1});

TEST(Declared, TwoSidedHoldsForBothSides) {
  EXPECT_EQ(fault(from_behind, at_the_back, none), Disagreement::false_hit);
  EXPECT_EQ(fault(from_behind, miss(), none), right);
  EXPECT_EQ(fault(from_behind, at_the_back, two_sided), right);
  EXPECT_EQ(fault(from_behind, miss(), two_sided), Disagreement::false_miss);
  EXPECT_EQ(fault(from_behind, hit({1.25, 1, 1, 0, 0, 0, -1}), two_sided), Disagreement::wrong_time);
  EXPECT_EQ(fault(from_behind, hit({1, 1, 1.5, 0, 0, 0, -1}), two_sided), Disagreement::wrong_place);
  EXPECT_EQ(fault(from_behind, hit({1, 1, 1, 0, 0, 0, 1}), two_sided), Disagreement::wrong_normal);
  const Case from_front = asked("moving_point_triangle", {1, 1, 2, 0, 0, -2, 0, 0, 0, 4, 0, 0, 0, 4, 0});
  EXPECT_EQ(fault(from_front, hit({1, 1, 1, 0, 0, 0, 1}), two_sided), right);
  EXPECT_EQ(fault(from_front, hit({1.25, 1, 1, 0, 0, 0, 1}), two_sided), Disagreement::wrong_time);
}

TEST(Declared, TwoSidedWeightsAreThoseOfTheGivenCorners) {
  const Case ball = asked("moving_sphere_triangle", {1, 0.5, -3, 1, 0, 0, 2, 0, 0, 0, 4, 0, 0, 0, 4, 0});
  EXPECT_EQ(fault(ball, hit({1, 1, 0.5, 0, 0, 0, -1, 0.625, 0.25, 0.125}), two_sided), right);
  EXPECT_EQ(fault(ball, hit({1, 1, 0.5, 0, 0, 0, -1, 0.625, 0.125, 0.25}), two_sided), Disagreement::wrong_weight);
}

/// A sphere that meets both triangles of a folded rectangle, one from its front and one from its back.
TEST(Declared, OfTwoSidesTheEarlierHitCounts) {
  const Query& query = *find_query("moving_sphere_rectangle");
  std::size_t both = 0;
  Case c;
  for (std::uint64_t i = 0; i < 400; ++i) {
    generate_inside(c, query, Scalar::float64, stream(11), i, {});
    const Truth front = truth_of(c), back = truth_of(*seen_from_behind(c));
    if (!front.yes || !back.yes) continue;
    const double one = front.alternatives[0].nearest[0], other = back.alternatives[0].nearest[0];
    if (!(std::max(one, other) > 2 * std::min(one, other))) continue;
    ++both;
    Answer earlier = hit({std::min(one, other)}), later = hit({std::max(one, other)});
    earlier.given = later.given = 1;
    EXPECT_EQ(fault(c, earlier, two_sided), right) << i;
    EXPECT_EQ(fault(c, later, two_sided), Disagreement::wrong_time) << i;
  }
  EXPECT_GE(both, 4u);
}

TEST(Declared, APlaneWithTwoSidesPushesToTheNearerSide) {
  const Case below = asked("sphere_plane_penetration", {0, 0, -0.5, 1, 0, 0, 1, 0});
  const Answer at_the_back_of_plane = hit({0.5, 0, 0, -1, 0, 0, 0.5});
  EXPECT_NE(fault(below, at_the_back_of_plane, none), right);
  EXPECT_EQ(fault(below, at_the_back_of_plane, two_sided), right);
  EXPECT_EQ(fault(below, hit({1.5, 0, 0, -1, 0, 0, 0.5}), two_sided), Disagreement::wrong_depth);
}

TEST(Declared, TheNormalOfTheFront) {
  constexpr Conventions front{Convention::two_sided, Convention::normal_of_front};
  EXPECT_EQ(fault(from_behind, hit({1, 1, 1, 0, 0, 0, 1}), front), right);
  EXPECT_EQ(fault(from_behind, at_the_back, front), Disagreement::wrong_normal);
}

TEST(Declared, NormalsReversed) {
  constexpr Conventions reversed{Convention::normal_reversed};
  const Case c = asked("sphere_sphere_penetration", {0, 0, 0, 1, 1, 0, 0, 1});
  EXPECT_EQ(fault(c, hit({1, -1, 0, 0, 1, 0, 0}), reversed), right);
  EXPECT_EQ(fault(c, hit({1, 1, 0, 0, 1, 0, 0}), reversed), Disagreement::wrong_normal);
  EXPECT_EQ(truth_of(c, reversed).alternatives.at(0).nearest.at(1), -1);
}

/// A unit ball that overlaps the other at the start and moves on.
const Case overlapping = asked("moving_sphere_sphere", {0, 0, 0, 1, 1, 0, 0, 1.5, 0, 0, 1});
const Answer hit_at_start = hit({0, 0.5, 0, 0, -1, 0, 0});

TEST(Declared, AStartInContactIsAMiss) {
  constexpr Conventions declared{Convention::start_is_miss};
  EXPECT_EQ(fault(overlapping, hit_at_start, none), right);
  EXPECT_EQ(fault(overlapping, hit_at_start, declared), Disagreement::false_hit);
  EXPECT_EQ(fault(overlapping, miss(), declared), right);
  EXPECT_EQ(fault(overlapping, miss(), none), Disagreement::false_miss);
  const Finding f = judge(overlapping, hit_at_start, {{.backward = 1e6}, false, {}, declared}, Detail::full);
  EXPECT_EQ(f.verdict, Verdict::exceeds_measure) << "far inside no input near it is a hit";
  EXPECT_EQ(truth_of(overlapping, declared).because, "a start in contact is a miss");
  const Case apart = asked("moving_sphere_sphere", {-3, 0, 0, 1, 1, 0, 0, 1.5, 0, 0, 1});
  EXPECT_EQ(fault(apart, miss(), declared), Disagreement::false_miss);
}

TEST(Declared, AStartInContactIsAHit) {
  constexpr Conventions declared{Convention::start_is_hit};
  const Case inside = asked("moving_point_box", {0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1});
  EXPECT_EQ(fault(inside, miss(), none), right);
  EXPECT_EQ(fault(inside, miss(), declared), Disagreement::false_miss);
  EXPECT_EQ(fault(inside, hit({0, 7, 0, 0, 0, 1, 0}), declared), right) << "any place and any normal";
  EXPECT_EQ(fault(inside, hit({1, 1, 0, 0, 1, 0, 0}), declared), Disagreement::wrong_time);
  EXPECT_EQ(fault(overlapping, hit({0, 9, 0, 0, -1, 0, 0}), declared), Disagreement::off_surface)
      << "the place of what the catalogue calls a hit";
}

TEST(Declared, AStartInContactIsAHitWhereItLeaves) {
  constexpr Conventions declared{Convention::exit_from_start};
  const Case in_box = asked("moving_point_box", {0.5, 0, 0, 2, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1});
  EXPECT_EQ(fault(in_box, hit({0.25, 1, 0, 0, 1, 0, 0}), declared), right);
  EXPECT_EQ(fault(in_box, hit({0.3, 1, 0, 0, 1, 0, 0}), declared), Disagreement::wrong_time);
  EXPECT_EQ(fault(in_box, hit({0.25, 1, 0.25, 0, 1, 0, 0}), declared), Disagreement::wrong_place);
  EXPECT_EQ(fault(in_box, miss(), declared), Disagreement::false_miss);
  const Case in_ball = asked("moving_point_sphere", {0, 0, 0, 1, 0, 0, 0, 0, 0, 2, 1});
  EXPECT_EQ(fault(in_ball, hit({2, 2, 0, 0, 1, 0, 0}), declared), right);
  EXPECT_EQ(fault(in_ball, hit({0, 0, 0, 0, 1, 0, 0}), declared), Disagreement::wrong_time);
}

TEST(Declared, AMotionEndsAtTimeOne) {
  constexpr Conventions declared{Convention::ends_at_time_one};
  const auto after = [](double time) {
    return asked("moving_point_sphere", {-1 - time, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1});
  };
  const auto answer = [](double time) { return hit({time, -1, 0, 0, -1, 0, 0}); };
  EXPECT_EQ(fault(after(1), answer(1), declared), right) << "time 1 itself belongs to the motion";
  EXPECT_EQ(fault(after(1), miss(), declared), Disagreement::false_miss);
  EXPECT_EQ(fault(after(2), answer(2), declared), Disagreement::false_hit);
  EXPECT_EQ(fault(after(2), miss(), declared), right);
  EXPECT_EQ(fault(after(2), miss(), none), Disagreement::false_miss);
  EXPECT_EQ(fault(after(0.5), answer(0.25), declared), Disagreement::wrong_time);
  EXPECT_EQ(fault(after(1 + 0x1p-51), answer(1 + 0x1p-51), declared), Disagreement::false_hit) << "exactly";
  const Case passes = asked("moving_sphere_passes_sphere", {-5, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1, 9, 0});
  EXPECT_TRUE(exact_decision(passes, none));
  EXPECT_FALSE(exact_decision(passes, declared));
}

TEST(Declared, ATouchIsAMiss) {
  constexpr Conventions declared{Convention::strict_touch};
  const Case touch = asked("sphere_sphere_overlap", {0, 0, 0, 1, 2, 0, 0, 1});
  ASSERT_TRUE(touches_exactly(touch));
  EXPECT_EQ(fault(touch, hit({}), declared), Disagreement::false_hit);
  EXPECT_EQ(fault(touch, miss(), declared), right);
  EXPECT_EQ(fault(touch, miss(), none), Disagreement::false_miss);
  const Case overlap = asked("sphere_sphere_overlap", {0, 0, 0, 1, 2 - 0x1p-52, 0, 0, 1});
  EXPECT_EQ(fault(overlap, miss(), declared), Disagreement::false_miss);
}

TEST(Declared, ThePlaceIsTheCenter) {
  constexpr Conventions declared{Convention::center_for_contact};
  const Case c = asked("moving_sphere_sphere", {-4, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1});
  EXPECT_EQ(fault(c, hit({2, -2, 0, 0, -1, 0, 0}), declared), right);
  EXPECT_EQ(fault(c, hit({2, -1, 0, 0, -1, 0, 0}), declared), Disagreement::wrong_place);
  EXPECT_EQ(fault(c, hit({2, -2 + 0x1p-50, 0, 0, -1, 0, 0}), declared), Disagreement::wrong_place) << "by 4 ulps";
}

/// The right answer itself, as far as it has numbers; without normals where many are right.
Answer answer_of(const Query& query, const Alternative& right_one) {
  Answer a;
  a.yes = right_one.yes, a.given = 0;
  for (std::size_t i = 0; i < std::min(right_one.count, query.outputs.size()); ++i) {
    a.values[i] = right_one.nearest[i];
    const bool is_open = right_one.many_normals && query.outputs[i].role == Role::normal;
    if (!is_open && std::isfinite(right_one.nearest[i])) a.given |= std::uint64_t{1} << i;
  }
  if (!a.yes && query.kind == Kind::impact) {
    for (std::size_t i = 0; i < query.outputs.size(); ++i) {
      if (query.outputs[i].role == Role::time) a.values[i] = infinity;
    }
  }
  return a;
}

class EveryDeclared : public testing::TestWithParam<NamedQuery> {};
INSTANTIATE_FOR_EVERY_QUERY(Every, EveryDeclared, testing::ValuesIn(every_query()), testing::PrintToStringParamName());

/// What is right by a convention is never accused, and the opposite decision is not called right.
TEST_P(EveryDeclared, RightAnswersAreNeverAccused) {
  const Query& query = *GetParam().query;
  const Standard by_measure{{.backward = 0x1p20, .unit = 0x1p20}, false};
  for (const Convention convention : all_conventions) {
    if (!concerns(convention, query)) continue;
    Standard standard = by_measure;
    standard.declared = {convention};
    Case c;
    for (std::uint64_t i = 0; i < 40; ++i) {
      if (i == 20 && concerns(Convention::normal_reversed, query)) standard.declared.add(Convention::normal_reversed);
      generate_inside(c, query, scalars[i % 2], stream(11), i, {});
      const Truth t = truth_of(c, standard.declared);
      for (const Alternative& one : t.alternatives) {
        EXPECT_EQ(one.yes, t.yes) << name_of(convention) << " " << i;
        const Finding f = confirmed(c, answer_of(query, one), standard, Detail::verdict);
        EXPECT_FALSE(f.is_proved()) << name_of(convention) << " " << i << ": " << f.clause;
        EXPECT_EQ(f.truth_yes, t.yes) << name_of(convention) << " " << i;
      }
      for (const Alternative& other : truth_of(c).alternatives)
        EXPECT_NO_THROW(confirmed(c, answer_of(query, other), standard, Detail::verdict)) << name_of(convention) << i;
      EXPECT_FALSE(t.alternatives.empty()) << name_of(convention) << " " << i;
      if (!decides(query.kind)) continue;
      Answer opposite;
      opposite.yes = !t.yes, opposite.given = 0;
      EXPECT_NE(confirmed(c, opposite, standard, Detail::verdict).verdict, Verdict::agrees) << name_of(convention) << i;
    }
  }
}

/// The bound of a proof: an answer that is right for some input within k epsilon has no backward error above k.
TEST_P(EveryDeclared, BoundsHoldForEveryInputNearby) {
  const Query& query = *GetParam().query;
  std::mt19937_64 draw(stream(13));
  std::uniform_real_distribution<double> share(-0.99, 0.99);
  constexpr std::uint64_t cases = 12, rungs_drawn = 40;
  for (const Convention convention : all_conventions) {
    if (!concerns(convention, query)) continue;
    Case c;
    for (std::uint64_t i = 0; i < cases; ++i) {
      generate_inside(c, query, Scalar::float64, stream(13), i, {});
      const double k = std::ldexp(1.0, int(draw() % rungs_drawn));
      const std::vector<double> moves = widening(query, c.values, c.scalar, k);
      Case near = c;
      for (std::size_t n = 0; n < moves.size(); ++n) near.values[n] += moves[n] * share(draw);
      if (query.broken(near.values)) continue;
      const Standard within_k{{.backward = 1.001 * k, .unit = 1e300}, false, {}, {convention}};
      for (const Alternative& one : truth_of(near, within_k.declared).alternatives) {
        const Finding f = confirmed(c, answer_of(query, one), within_k, Detail::verdict);
        EXPECT_FALSE(f.is_proved()) << name_of(convention) << " " << i << " " << k << ": " << f.clause;
      }
    }
  }
}

/// The generator needs no other cases for a declaration.
TEST(Conventions, HaveEnoughGeneratedCases) {
  constexpr int cases = 500;
  for (const Query& q : catalogue()) {
    int from_behind_alone = 0, in_contact = 0;
    Case c;
    for (int i = 0; i < cases && q.operands.start; ++i) {
      generate_inside(c, q, Scalar::float64, stream(12), std::uint64_t(i), {});
      in_contact += contact_at_start(c) == true;
      from_behind_alone += q.traits.one_sided && !exact_decision(c, none) && exact_decision(*seen_from_behind(c), none);
    }
    if (!q.operands.start) continue;
    EXPECT_GE(in_contact, cases / 25) << q.name;
    EXPECT_TRUE(!q.traits.one_sided || from_behind_alone >= cases / 8) << q.name << " " << from_behind_alone;
  }
}

TEST(Conventions, OfUnitDirectionsAreAPrecondition) {
  Offering o;
  o.declare({{Convention::unit_directions, "A direction is a unit vector."}});
  EXPECT_TRUE(o.required.has(Precondition::unit_direction));
}

/// A meaning without its opposite: each of the three about a start in contact excludes the two others.
TEST(Conventions, OfStartsContradictEachOther) {
  const Conventions misses{Convention::start_is_miss};
  EXPECT_EQ(contradicted(Convention::start_is_hit, misses), Convention::start_is_miss);
  EXPECT_EQ(contradicted(Convention::exit_from_start, misses), Convention::start_is_miss);
  EXPECT_FALSE(contradicted(Convention::start_is_miss, misses));
  EXPECT_FALSE(contradicted(Convention::two_sided, misses));
}

TEST(Conventions, HaveNamesThatAreFoundAgain) {
  for (const Convention c : all_conventions) EXPECT_EQ(convention_named(name_of(c)), c);
  EXPECT_FALSE(convention_named("no such convention"));
  for (const Convention c : all_conventions) {
    EXPECT_TRUE(std::any_of(catalogue().begin(), catalogue().end(), [&](const Query& q) { return concerns(c, q); }))
        << name_of(c);
  }
}

}  // namespace
}  // namespace nearmiss
