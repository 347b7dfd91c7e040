/// The answers to related cases are related like the exact answers: for each tier, and for the oracle.
#include "corpus/relations/verdict.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "corpus/generator/case_builder.hpp"
#include "corpus/generator/generator.hpp"
#include "corpus/storage/codec.hpp"
#include "corpus/storage/store.hpp"
#include "oracles/confirmed.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

Answer asked_here(const Subject& subject, const Case& c) { return subject.offering(c.query->name).answer(c.values); }

/// A bitwise claim concerns our own tiers only: they use no epsilon.
std::optional<RelationFinding> examined(const Relation& r, const Case& c, std::uint64_t seed, const Subject& s,
                                        bool bit_for_bit) {
  return examine(
      r, c, seed, s, [&](const Case& asked) { return asked_here(s, asked); }, bit_for_bit);
}

bool is_certified(const Subject& s) {
  return s.own && std::all_of(s.offerings.begin(), s.offerings.end(),
                              [](const Offering& o) { return promises_every_digit(o.contract); });
}

class EveryTierRelated : public testing::TestWithParam<Pairing> {};

TEST_P(EveryTierRelated, KeepsEveryRelationOfItsAnswers) {
  const auto [query, subject] = GetParam();
  const std::uint64_t cases = is_certified(*subject) ? 200 : 1500;
  EXPECT_EQ(failure_of_relations(*query, *subject, stream(11), cases), "");
}

/// Eight changes per relation.
TEST_P(EveryTierRelated, KeepsEveryRelationOfItsAnswersToStoredCases) {
  const auto [query, subject] = GetParam();
  for (const StoredCase& s : stored_cases(*query)) {
    if (s.question.scalar != subject->scalar) continue;
    for (const Relation& r : relations()) {
      for (std::uint64_t seed = 0; seed < 8; ++seed) {
        const auto found = examined(r, s.question, seed, *subject, claims_same_bits(*subject));
        EXPECT_TRUE(!found || (found->broken.empty() && found->oracle.empty()))
            << s.file << " " << r.name << " " << seed;
      }
    }
  }
}

INSTANTIATE_FOR_EVERY_QUERY(Relations, EveryTierRelated, testing::ValuesIn(our_pairings()),
                            testing::PrintToStringParamName());

/// Consequences of the answer alone, or of another query asked at the time of impact.
class CertifiedPostconditions : public testing::TestWithParam<Pairing> {};

std::size_t output(const Query& q, std::string_view name) {
  std::size_t i = 0;
  while (i < q.outputs.size() && q.outputs[i].name != name) ++i;
  return i;
}
std::size_t input(const Query& q, std::string_view name) {
  std::size_t i = 0;
  while (i < q.inputs.size() && q.inputs[i].name != name) ++i;
  return i;
}

/// A point has normals in every direction, and so have two operands of size 0 where they meet.
bool has_no_size_somewhere(const Case& c) {
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.role(i) == Role::size && c.values[i] == 0) return true;
  }
  return false;
}

/// normal . velocity; each component of the normal is within 2 ulp, after a division by a length within 4 epsilon.
bool against_the_motion(const Case& c, const Answer& a) {
  const std::size_t n = output(*c.query, "normal.x"), v = input(*c.query, "velocity.x");
  const double eps = unit_roundoff(c.scalar);
  long double along = 0, bound = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    along += static_cast<long double>(a.values[n + k]) * c.values[v + k];
    bound += 8 * eps * std::abs(c.values[v + k]);
  }
  return along <= bound;
}

/// Weights are within 2 ulp of the largest weight.
bool weights_add_up(const Case& c, const Answer& a) {
  const std::size_t w = output(*c.query, "weights.x");
  const double sum = a.values[w] + a.values[w + 1] + a.values[w + 2];
  const double largest = std::max({1.0, std::abs(a.values[w]), std::abs(a.values[w + 1]), std::abs(a.values[w + 2])});
  return std::abs(sum - 1) <= 8 * ulp(largest, c.scalar);
}

/// At the time of impact the sphere overlaps the solid, if enlarged by the possible rounding error of its place.
bool touches_at_impact(const Case& c, const Answer& a, const Subject& s) {
  const std::map<std::string_view, std::string_view> overlaps{{"moving_sphere_sphere", "sphere_sphere_overlap"},
                                                              {"moving_sphere_box", "sphere_box_overlap"},
                                                              {"moving_sphere_triangle", "sphere_triangle_overlap"}};
  const auto overlap = overlaps.find(c.query->name);
  if (overlap == overlaps.end()) return true;
  const std::size_t v = input(*c.query, "velocity.x");  // after the sphere's center and radius
  const double t = a.values[output(*c.query, "time")];
  Case there{find_query(overlap->second), c.scalar, {}, "relation", 0, 0, {}};
  there.values.assign(c.values.begin(), c.values.begin() + 4);
  there.values.insert(there.values.end(), c.values.begin() + long(v) + 3, c.values.end());
  double growth = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double step = c.values[v + k] * t, at = c.values[k] + step;
    if (!std::isfinite(at)) return true;
    there.values[k] = c.scalar == Scalar::float32 ? double(float(at)) : at;
    growth += 2 * ulp(t, c.scalar) * std::abs(c.values[v + k]) + ulp(step, c.scalar) + ulp(at, c.scalar);
  }
  // The sum itself is rounded, and so is the radius.
  const double radius = c.values[3] + 2 * growth;
  there.values[3] = radius + 2 * ulp(radius, c.scalar);
  if (c.scalar == Scalar::float32) there.values[3] = double(float(there.values[3]));
  return asked_here(s, there).yes;
}

/// The location has the right distance from a sphere's center, or from a plane, within 2 ulp of each number.
bool lies_on_the_surface(const Case& c, const Answer& a) {
  const std::size_t x = output(*c.query, "location.x");
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::isinf(a.values[x + k])) return true;  // beyond the largest number: the distance cannot be told
  }
  const auto distance = [&](const char* center, long double& rounding) {
    const std::size_t at = input(*c.query, center);
    long double sum = 0;
    rounding = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const long double d = static_cast<long double>(a.values[x + k]) - c.values[at + k];
      const double largest = std::max({std::abs(a.values[x]), std::abs(a.values[x + 1]), std::abs(a.values[x + 2])});
      sum += d * d;
      rounding += 2 * ulp(largest, c.scalar);
    }
    return std::sqrt(sum);
  };
  const char* fixed = c.query->name == "moving_sphere_sphere"  ? "fixed"
                      : c.query->name == "moving_point_sphere" ? "sphere"
                                                               : nullptr;
  if (fixed != nullptr) {
    const double radius = c.values[input(*c.query, fmt::format("{}.radius", fixed))];
    long double rounding = 0;
    const long double reached = distance(fmt::format("{}.center.x", fixed).c_str(), rounding);
    return std::abs(reached - radius) <= rounding + 4 * ulp(radius, c.scalar);
  }
  const std::size_t n = input(*c.query, "plane.normal.x");
  if (n == c.fields().size()) return true;
  long double value = c.values[n + 3], bound = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    value += static_cast<long double>(c.values[n + k]) * a.values[x + k];
    const double largest = std::max({std::abs(a.values[x]), std::abs(a.values[x + 1]), std::abs(a.values[x + 2])});
    bound += (2.5L * ulp(largest, c.scalar)) * std::abs(c.values[n + k]);
  }
  return std::abs(value) <= bound + 1e-18L * std::abs(c.values[n + 3]);
}

/// Which consequence the answer violates; "" if none.
std::string broken_postcondition(const Case& c, const Subject& s) {
  const Query& query = *c.query;
  const std::size_t time = output(query, "time"), solid = input(query, "solid");
  const Answer a = asked_here(s, c);
  if (!a.yes) return {};
  if (output(query, "weights.x") < query.outputs.size() && !weights_add_up(c, a))
    return "the weights do not add up to 1";
  if (query.kind != Kind::impact) return {};
  if (!touches_at_impact(c, a, s)) return "there is no touch at the time of impact";
  // A point that starts inside a solid is in contact at the start.
  if (a.values[time] > 0 && !lies_on_the_surface(c, a)) return "the location is not on the surface";
  const bool leaves_a_shell = solid < query.inputs.size() && c.values[solid] == 0;
  const bool arrives = a.values[time] > 0 && !leaves_a_shell && !has_no_size_somewhere(c);
  if (arrives && !against_the_motion(c, a)) return "the normal does not point against the motion";
  return {};
}

TEST_P(CertifiedPostconditions, FollowFromEveryAnswer) {
  const auto [query, subject] = GetParam();
  const auto failure_of = [s = subject](const Case& c) { return broken_postcondition(c, *s); };
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Case c = generate(*query, subject->scalar, stream(23), i);
    ASSERT_EQ(failure_of(c), "") << failure_text(c, *subject, failure_of);
  }
}

INSTANTIATE_FOR_EVERY_QUERY(Relations, CertifiedPostconditions, testing::ValuesIn([] {
                              std::vector<Pairing> certified;
                              for (const Pairing& p : our_pairings()) {
                                if (is_certified(*p.subject)) certified.push_back(p);
                              }
                              return certified;
                            }()),
                            testing::PrintToStringParamName());

/// The oracle as a subject that gives decisions only.
class RelatedTruths : public testing::TestWithParam<NamedQuery> {};

TEST_P(RelatedTruths, KeepEveryRelationOfTheirDecisions) {
  const Query& query = *GetParam().query;
  if (!decides(query.kind)) GTEST_SKIP() << "the answer is always yes";
  const auto truth = [](const Case& c) {
    Answer a;
    a.yes = truth_is_yes(c);
    a.given = 0;
    return a;
  };
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Case c = generate(query, Scalar::float64, 13, i);
    for (const Relation& r : relations()) {
      const auto follow_ups = r.of(c, i);
      if (!follow_ups) continue;
      std::vector<Answer> others;
      for (const Case& other : follow_ups->cases) others.push_back(truth(other));
      ASSERT_NE(follow_ups->compare(truth(c), others), Agreement::decisions_differ)
          << r.name << "\n"
          << case_to_json(c).dump() << "\n"
          << case_to_json(follow_ups->cases[0]).dump();
    }
  }
}

INSTANTIATE_FOR_EVERY_QUERY(Every, RelatedTruths, testing::ValuesIn(every_query()), testing::PrintToStringParamName());

/// A subject that leaves out some numbers of its answers, differently in each; 1e308 and NaN take their place.
class ForgetfulSubject : public testing::TestWithParam<NamedQuery> {};

TEST_P(ForgetfulSubject, MakesNobodyContradictThemselves) {
  const Query& query = *GetParam().query;
  const Subject& subject = *find_subject("collide-certified-double");
  Random random(stream(23));  // chooses the numbers to leave out
  const auto forgetful = [&](const Case& c) {
    Answer a = asked_here(subject, c);
    a.given = random.bits();
    for (std::size_t i = 0; i < Answer::capacity; ++i) {
      if (!a.gives(i)) a.values[i] = random.one_in(2) ? 1e308 : std::numeric_limits<double>::quiet_NaN();
    }
    return a;
  };
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Case c = generate(query, Scalar::float64, stream(23), i);
    for (const Relation& r : relations()) {
      const auto found = examine(r, c, i, subject, forgetful, true);
      ASSERT_TRUE(!found || found->oracle.empty()) << r.name << ": " << found->oracle << "\n" << case_to_json(c).dump();
      ASSERT_TRUE(!found || found->breach != Breach::bits) << r.name << ": " << found->broken << "\n"
                                                           << case_to_json(c).dump();
    }
  }
}

INSTANTIATE_FOR_EVERY_QUERY(Every, ForgetfulSubject, testing::ValuesIn(every_query()),
                            testing::PrintToStringParamName());

TEST(Relations, EachApplyToManyCasesOfSomeQuery) {
  constexpr std::uint64_t cases = 400;
  std::map<std::string_view, std::uint64_t> most;
  for (const Query& q : catalogue()) {
    std::map<std::string_view, std::uint64_t> here;
    for (std::uint64_t i = 0; i < cases; ++i) {
      const Case c = generate(q, Scalar::float64, 5, i);
      for (const Relation& r : relations()) here[r.name] += r.of(c, i).has_value();
    }
    for (const auto& [name, count] : here) most[name] = std::max(most[name], count);
  }
  for (const Relation& r : relations()) EXPECT_GE(most[r.name], cases / 100) << r.name;
}

TEST(Relations, GiveFollowUpsThatAreValidAndExactInTheirScalar) {
  for (const Query& q : catalogue()) {
    for (Scalar scalar : scalars) {
      for (std::uint64_t i = 0; i < 100; ++i) {
        const Case c = generate(q, scalar, 17, i);
        for (const Relation& r : relations()) {
          const auto follow_ups = r.of(c, i);
          if (!follow_ups) continue;
          for (const Case& other : follow_ups->cases) {
            ASSERT_FALSE(other.query->broken(other.values)) << r.name << " " << q.name;
            for (double x : other.values) ASSERT_TRUE(representable(x, scalar)) << r.name << " " << q.name;
          }
        }
      }
    }
  }
}

/// The certified tier with a typical mistake of collision libraries.
using Mistake = Answer (*)(std::span<const double>);

const Answer& right(std::string_view query, std::span<const double> values) {
  static thread_local Answer a;
  a = find_subject("collide-certified-double")->offering(query).answer(values);
  return a;
}

Subject mistaken(std::string_view query, Mistake answer) {
  Subject s = *find_subject("collide-certified-double");
  for (Offering& o : s.offerings) {
    if (o.query == query) o.answer = answer;
  }
  return s;
}

/// A point misses a box by 3.5 times the promised error: two places and a half-extent may move, and a radius as well if
/// there is one.
TEST(Relations, AnAnswerThatALostNumberMakesRightIsNoContradiction) {
  constexpr double error = 0x1p-6;
  const Relation& relation = *find_relation("sphere-as-point");
  const Case c{find_query("moving_sphere_box"),
               Scalar::float64,
               {0, 1 + 3.5 * error, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1},
               "",
               0,
               0,
               {}};
  const FollowUps follow_ups = *relation.of(c, 0);
  Subject measured = *find_subject("collide-certified-double");
  for (Offering& o : measured.offerings) o.contract = {.backward = error / 0x1p-53, .forward = 0x1p53, .unit = 0x1p50};
  const Answer hit = right("moving_point_box", std::vector<double>{0, 1, 0, 0, -1, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1});
  const Answer miss = right("moving_point_box", follow_ups.cases[0].values);
  ASSERT_TRUE(hit.yes && !miss.yes);
  const RelationFinding found = relate(relation, follow_ups, c, {hit, miss}, measured, false);
  EXPECT_FALSE(found.findings[0].is_proved()) << found.findings[0].clause;
  EXPECT_TRUE(
      confirmed(follow_ups.cases[0], hit, measured.standard_for("moving_point_box"), Detail::verdict).is_proved());
  EXPECT_EQ(found.oracle, "");
}

/// Near a bound the proof succeeds for one order of a capsule's ends and fails for the other.
TEST(Relations, AnAnswerThatIsNotProvedToBeWrongIsNotYetRight) {
  const Relation& relation = *find_relation("turned-corners");
  const Case c{find_query("moving_sphere_capsule"),
               Scalar::float64,
               {3.208552239228606, -3.6878210926869617, 3.9009941126583483, 0.150390625, 0.5017885250901633,
                -0.4910210782009093, -2.027119566426956, 4.438009534131537, -4.5367018818573035, 2.435438576593205,
                3.302302239228606, -3.5471960926869617, 3.8697441126583483, 0.021484375},
               "",
               0,
               0,
               {}};
  const FollowUps follow_ups = *relation.of(c, 0);
  Subject lenient = *find_subject("collide-certified-double");
  for (Offering& o : lenient.offerings) o.contract = {.backward = 0x1p40};
  const Answer hit = right("moving_sphere_capsule", c.values);
  const RelationFinding found = relate(relation, follow_ups, c, {Answer{}, hit}, lenient, false);
  EXPECT_EQ(found.findings[0].verdict, Verdict::not_proved);
  EXPECT_TRUE(
      confirmed(follow_ups.cases[0], Answer{}, lenient.standard_for(c.query->name), Detail::verdict).is_proved());
  EXPECT_EQ(found.oracle, "");
}

int broken_among(const Relation& r, std::string_view query, const Subject& s, int cases, bool bit_for_bit = false) {
  int broken = 0;
  for (int i = 0; i < cases; ++i) {
    const Case c = generate(*find_query(query), Scalar::float64, 19, std::uint64_t(i));
    const auto f = examined(r, c, std::uint64_t(i), s, bit_for_bit);
    broken += f && !f->broken.empty();
  }
  return broken;
}

struct Planted {
  std::string_view relation, query;
  Mistake mistake;
};

class EachRelation : public testing::TestWithParam<Planted> {};

TEST_P(EachRelation, CatchesAMistakeOfItsKind) {
  const auto& [relation, query, mistake] = GetParam();
  const Subject wrong = mistaken(query, mistake);
  EXPECT_GT(broken_among(*find_relation(relation), query, wrong, 300, true), 0);
  EXPECT_EQ(broken_among(*find_relation(relation), query, *find_subject("collide-certified-double"), 300, true), 0);
}

INSTANTIATE_TEST_SUITE_P(
    Planted, EachRelation,
    testing::Values(Planted{"scaled-lengths", "sphere_sphere_overlap",  // an absolute tolerance
                            [](std::span<const double> v) {
                              std::vector<double> w(v.begin(), v.end());
                              w[3] += 0.05;
                              return right("sphere_sphere_overlap", w);
                            }},
                    Planted{"scaled-time", "moving_sphere_passes_sphere",  // a limit that is cut off
                            [](std::span<const double> v) {
                              std::vector<double> w(v.begin(), v.end());
                              w[11] = std::min(w[11], 1.0);
                              return right("moving_sphere_passes_sphere", w);
                            }},
                    Planted{"reflected", "closest_point_segment",  // a sign
                            [](std::span<const double> v) {
                              Answer a = right("closest_point_segment", v);
                              if (v[0] > 0) a.values[0] += 0.5;
                              return a;
                            }},
                    Planted{"permuted-axes", "sphere_box_overlap",  // one axis forgotten
                            [](std::span<const double> v) {
                              std::vector<double> w(v.begin(), v.end());
                              w[2] = w[6];
                              return right("sphere_box_overlap", w);
                            }},
                    Planted{"translated", "moving_point_sphere",  // relative to the origin
                            [](std::span<const double> v) {
                              Answer a = right("moving_point_sphere", v);
                              if (v[0] > 8) a.yes = false, a.values[0] = HUGE_VAL;
                              return a;
                            }},
                    Planted{"rotated", "moving_sphere_sphere",  // the larger of two coordinates instead of a length
                            [](std::span<const double> v) {
                              std::vector<double> w(v.begin(), v.end());
                              w[3] = v[3] * (std::abs(v[4]) > std::abs(v[5]) ? 1 : 0.5);
                              return right("moving_sphere_sphere", w);
                            }},
                    Planted{"contained-ball", "moving_sphere_box",  // half of its half extents
                            [](std::span<const double> v) {
                              std::vector<double> w(v.begin(), v.end());
                              for (std::size_t k = 10; k < 13; ++k) w[k] = 0.5 * v[k];
                              return right("moving_sphere_box", w);
                            }},
                    Planted{"sphere-as-point", "moving_point_plane",  // two-sided
                            [](std::span<const double> v) {
                              std::vector<double> w(v.begin(), v.end());
                              const double along = v[3] * v[6] + v[4] * v[7] + v[5] * v[8];
                              for (std::size_t k = 6; along > 0 && k < 10; ++k) w[k] = -v[k];
                              return right("moving_point_plane", w);
                            }},
                    Planted{"sign-of-distance", "sphere_capsule_signed_distance",  // the radius of the sphere left out
                            [](std::span<const double> v) {
                              std::vector<double> w(v.begin(), v.end());
                              w[3] = 0;
                              return right("sphere_capsule_signed_distance", w);
                            }},
                    Planted{"grown-radius", "sphere_capsule_signed_distance",  // half of the radius of the sphere
                            [](std::span<const double> v) {
                              std::vector<double> w(v.begin(), v.end());
                              w[3] = 0.5 * v[3];
                              return right("sphere_capsule_signed_distance", w);
                            }},
                    Planted{"depth-of-distance", "sphere_box_penetration",  // a depth that is a quarter too large
                            [](std::span<const double> v) {
                              Answer a = right("sphere_box_penetration", v);
                              if (a.yes) a.values[0] *= 1.25;
                              return a;
                            }},
                    Planted{"gap-before-contact", "moving_capsule_halfspace",  // a time that is a quarter too short
                            [](std::span<const double> v) {
                              Answer a = right("moving_capsule_halfspace", v);
                              if (a.yes) a.values[0] *= 0.75;
                              return a;
                            }},
                    Planted{"distance-of-closest", "closest_point_segment",  // the end of the segment
                            [](std::span<const double> v) {
                              std::vector<double> w(v.begin(), v.end());
                              for (std::size_t k = 0; k < 3; ++k) w[k] = v[3 + k];
                              return right("closest_point_segment", w);
                            }},
                    Planted{"turned-corners", "moving_point_triangle",  // an edge that is left out
                            [](std::span<const double> v) {
                              std::vector<double> w(v.begin(), v.end());
                              w[6] = 2 * v[6] - v[9], w[7] = 2 * v[7] - v[10], w[8] = 2 * v[8] - v[11];
                              return right("moving_point_triangle", w);
                            }},
                    Planted{"reversed-corners", "sphere_triangle_overlap",  // tested from its front only
                            [](std::span<const double> v) {
                              Answer a = right("sphere_triangle_overlap", v);
                              const double ax = v[7] - v[4], ay = v[8] - v[5], bx = v[10] - v[4], by = v[11] - v[5];
                              if (ax * by < ay * bx) a.yes = false;
                              return a;
                            }},
                    Planted{"swapped", "box_box_overlap",  // the second box's size taken for the first
                            [](std::span<const double> v) {
                              std::vector<double> w(v.begin(), v.end());
                              w[13] = w[3];
                              return right("box_box_overlap", w);
                            }},
                    Planted{"another-hint", "box_box_overlap",  // a hint that decides
                            [](std::span<const double> v) {
                              Answer a = right("box_box_overlap", v);
                              if (v[20] == 3) a.yes = false;
                              return a;
                            }},
                    Planted{"later-start", "moving_sphere_box",  // a horizon
                            [](std::span<const double> v) {
                              Answer a = right("moving_sphere_box", v);
                              if (a.yes && a.values[0] > 0.75) a.yes = false, a.values[0] = HUGE_VAL;
                              return a;
                            }},
                    Planted{"grown-size",
                            "sphere_sphere_penetration",  // a contained sphere treated as if it were apart
                            [](std::span<const double> v) {
                              Answer a = right("sphere_sphere_penetration", v);
                              if (v[3] > 1.5) a.yes = false, a.values[0] = -1;
                              return a;
                            }},
                    Planted{"two-triangles", "moving_point_rectangle",  // the second triangle is forgotten
                            [](std::span<const double> v) {
                              std::vector<double> w(v.begin(), v.end());
                              for (std::size_t k = 0; k < 3; ++k) w[15 + k] = w[6 + k];
                              return right("moving_point_rectangle", w);
                            }},
                    Planted{"same-decision", "sphere_box_overlap",  // open instead of closed
                            [](std::span<const double> v) {
                              Answer a = right("sphere_box_overlap", v);
                              if (right("sphere_box_penetration", v).values[0] == 0) a.yes = false;
                              return a;
                            }}),
    [](const auto& planted) {
      std::string name(planted.param.relation);
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

}  // namespace
}  // namespace nearmiss
