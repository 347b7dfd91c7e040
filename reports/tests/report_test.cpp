/// Reports explain each kind of disagreement correctly, and are valid under their schema.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "corpus/storage/codec.hpp"
#include "reports/engine/replay.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/report_text.hpp"
#include "reports/tests/schema.hpp"

namespace nearmiss {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A subject that is never asked: the tests provide its answers.
Subject stooge(std::string_view query, const collide::Contract& contract) {
  const auto never = [](std::span<const double>) { return Answer::without(Answer::Status::broke, "asked"); };
  return {.name = "stooge",
          .version = "1",
          .scalar = Scalar::float64,
          .offerings = {{std::string(query), Offer::answers, "", contract, never}}};
}

/// The strictest promise.
constexpr collide::Contract strict{.backward = 0, .forward = 1, .exact_decisions = true, .unit = 4};

/// A ball of radius 1 that flies along x from -10 with speed 2, at the unit box around (0, y, 0).
Case flight(double y) {
  return {find_query("moving_sphere_box"),
          Scalar::float64,
          {-10, 0, 0, 1, 2, 0, 0, 0, y, 0, 1, 1, 1, 0, 0, 0, 1},
          "test",
          0,
          0,
          {}};
}
/// A ball of radius 1 at x against the unit box around 0.
Case overlap(double x) {
  return {find_query("sphere_box_penetration"),
          Scalar::float64,
          {x, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1},
          "test",
          0,
          0,
          {}};
}
/// A ball of radius 1 that overlaps the unit box around 0, and moves on into it.
/// Two cubes with half extents of 1, their centers `apart` along x.
std::vector<double> two_boxes(double apart) { return {0, 0, 0, 1, 1, 1, 0, 0, 0, 1, apart, 0, 0, 1, 1, 1, 0, 0, 0, 1}; }

Case overlapping() {
  Case c = flight(0);
  c.values[0] = -1.5;
  return c;
}
Case nearest() {
  return {find_query("closest_point_segment"), Scalar::float64, {0, 0, 0, 4, 0, 0, 1, 2, 0}, "test", 0, 0, {}};
}

Answer answer(bool yes, const std::vector<double>& values) {
  Answer a;
  a.yes = yes;
  std::copy(values.begin(), values.end(), a.values.begin());
  return a;
}
Answer miss() { return answer(false, {infinity, 0, 0, 0, 0, 0, 0}); }
Answer hit(double time, double y = 0, double normal_x = -1, double normal_y = 0) {
  return answer(true, {time, -1, y, 0, normal_x, normal_y, 0});
}

/// A report about a ball at rest, for a subject that requires a motion.
Report unasked_report() {
  Case still = flight(9);
  std::fill_n(still.values.begin() + 4, 3, 0.0);
  Subject s = stooge(still.query->name, strict);
  s.offerings.front().required = {Precondition::moves};
  Workers workers;
  Report r = examine(still, s, miss(), workers);
  r.replay = "nearmiss replay report.json";
  return r;
}

/// A report about a point just outside of a box that moves away, for a subject that requires a start outside.
Report report_at_a_border() {
  const Case leaving{find_query("moving_point_box"),
                     Scalar::float64,
                     {std::nextafter(1.0, 2.0), 0, 0, 1, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1},
                     "test",
                     0,
                     0,
                     {}};
  Subject s = stooge(leaving.query->name, {.backward = 8});
  s.offerings.front().required = {Precondition::starts_outside};
  Workers workers;
  Report r = examine(leaving, s, answer(true, {0, leaving.values[0], 0, 0, 1, 0, 0}), workers);
  r.replay = "nearmiss replay report.json";
  return r;
}
/// Two balls of radius 1 whose centers are x apart.
Case overlapping_spheres(double x) {
  return {find_query("sphere_sphere_penetration"), Scalar::float64, {0, 0, 0, 1, x, 0, 0, 1}, "test", 0, 0, {}};
}

Report report(const Case& question, const Answer& given, const collide::Contract& contract = strict) {
  Workers workers;
  Report r = examine(question, stooge(question.query->name, contract), given, workers);
  r.replay = "nearmiss replay report.json";
  return r;
}

using Touching = std::map<std::string, std::set<std::pair<bool, bool>>>;

/// The referees' answers before and after, by the source of the time.
Touching touching(const Report& r) {
  Touching said;
  for (const StaticCheck& c : r.static_checks) said[c.of].insert({c.said[0].yes, c.said[2].yes});
  return said;
}

TEST(Report, ChecksTimesOfContactByStaticQueries) {
  const auto is_referee = [](const Subject& s) { return s.referee; };
  const auto referees = std::count_if(subjects().begin(), subjects().end(), is_referee);
  if (referees == 0) GTEST_SKIP() << "no library of this build is a referee";
  using Said = std::set<std::pair<bool, bool>>;
  const Said contact{{false, true}}, within{{true, true}}, apart{{false, false}};
  EXPECT_EQ(touching(report(flight(0), hit(4))), (Touching{{"answer", contact}}));
  EXPECT_EQ(touching(report(flight(0), hit(4.0625))), (Touching{{"answer", within}, {"truth", contact}}));
  EXPECT_EQ(touching(report(flight(0), miss())), (Touching{{"truth", contact}}));
  EXPECT_EQ(touching(report(flight(5), hit(4))), (Touching{{"answer", apart}}));
  EXPECT_EQ(touching(report(flight(5), miss())), Touching{});
  EXPECT_EQ(touching(report(nearest(), answer(true, {2, 0, 0}))), Touching{});

  const Report r = report(flight(0), hit(4));
  ASSERT_EQ(r.static_checks.size(), std::size_t(referees));
  for (const StaticCheck& c : r.static_checks) {
    EXPECT_EQ(c.query, "sphere_box_overlap");
    EXPECT_EQ(c.times, (std::array<double, 3>{4 - 0x1p-11, 4, 4 + 0x1p-11}));
  }
}

/// The static check places a moving point as a ball of radius zero.
TEST(Report, ChecksTimesOfPoints) {
  const auto says = [](const char* query, std::vector<double> values) {
    const Case c{find_query(query), Scalar::float64, std::move(values), "test", 0, 0, {}};
    return touching(report(c, answer(true, {3, 0, 0, 0, 0, 0, 0})));
  };
  if (report(flight(0), hit(4)).static_checks.empty()) GTEST_SKIP() << "no library of this build is a referee";
  const Touching contact{{"answer", {{false, true}}}};
  EXPECT_EQ(says("moving_point_box", {-4, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1}), contact);
  EXPECT_EQ(says("moving_point_sphere", {-4, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1}), contact);
}

struct Expectation {
  const char* name;
  Report (*make)();
  Verdict verdict;
  Disagreement disagreement;
  const char* says;  ///< part of the explanation
};
void PrintTo(const Expectation& e, std::ostream* out) { *out << e.name; }

const Expectation expectations[] = {
    {"agrees", [] { return report(flight(0), hit(4)); }, Verdict::agrees, Disagreement::none,
     "stooge agrees with the exact answer. Exactly, it is a hit at time 4."},
    {"agrees_on_a_miss", [] { return report(flight(5), miss()); }, Verdict::agrees, Disagreement::none,
     "Exactly, it is a miss."},
    {"false_miss", [] { return report(flight(0), miss()); }, Verdict::violates_contract, Disagreement::false_miss,
     "stooge says that the sphere does not hit the box. Exactly, it is a hit at time 4. Even after moving every "
     "position by up to"},
    {"false_hit", [] { return report(flight(5), hit(4)); }, Verdict::violates_contract, Disagreement::false_hit,
     "stooge says that the sphere hits the box at time 4. Exactly, it is a miss."},
    {"wrong_time", [] { return report(flight(0), hit(4.5)); }, Verdict::violates_contract, Disagreement::wrong_time,
     "stooge gives time 4.5. Exactly, it is 4: time is off by 0.5 (in which the motion covers 1, 0.1 of the largest "
     "position or size)"},
    {"wrong_place", [] { return report(flight(0), hit(4, 0.5)); }, Verdict::violates_contract,
     Disagreement::wrong_place,
     "stooge gives location (-1, 0.5, 0). Exactly, it is (-1, 0, 0): location.y is off by 0.5"},
    {"wrong_point",
     [] {
       return report(nearest(), answer(true, {2, 0, 0}));
     },
     Verdict::violates_contract, Disagreement::wrong_place, "stooge gives point (2, 0, 0). Exactly, it is (1, 0, 0)"},
    {"off_surface",
     [] {
       return report(nearest(), answer(true, {1, 0.25, 0}));
     },
     Verdict::violates_contract, Disagreement::off_surface,
     "stooge gives point (1, 0.25, 0), which is off the surface that it is to lie on. Exactly, it is (1, 0, 0)"},
    {"off_surface_by_less_than_the_contract",
     [] {
       return report(nearest(), answer(true, {1, 0x1p-40, 0}), {.backward = 0x1p14});
     },
     Verdict::not_proved, Disagreement::wrong_place, "It is not proved to differ by more than it promises."},
    {"off_in_a_contract_of_ulps",
     [] {
       return report(nearest(), answer(true, {1, 0x1p-40, 0}), {.forward = 2});
     },
     Verdict::violates_contract, Disagreement::off_surface, "It promises forward error at most 2 ulp."},
    {"wrong_normal", [] { return report(flight(0), hit(4, 0, 0, 1)); }, Verdict::violates_contract,
     Disagreement::wrong_normal, "stooge gives normal (0, 1, 0). Exactly, it is (-1, 0, 0)"},
    {"wrong_depth",
     [] {
       return report(overlap(1.5), answer(true, {0.25, -1, 0, 0, 1, 0, 0}));
     },
     Verdict::violates_contract, Disagreement::wrong_depth, "stooge gives depth 0.25. Exactly, it is 0.5"},
    {"false_miss_of_depth",
     [] {
       return report(overlap(1.5), answer(false, {-0.5, 0, 0, 0, 0, 0, 0}));
     },
     Verdict::violates_contract, Disagreement::false_miss,
     "stooge says that the sphere and the box are apart, depth -0.5. Exactly, they touch or overlap, depth 0.5."},
    {"wrong_distance",
     [] {
       std::vector<double> values = two_boxes(4);
       values.push_back(0);  // the axis
       const Case c{find_query("box_box_projected_distance"), Scalar::float64, values, "test", 0, 0, {}};
       return report(c, answer(true, {1.5}));
     },
     Verdict::violates_contract, Disagreement::wrong_distance, "stooge gives value 1.5. Exactly, it is 2"},
    {"wrong_size",
     [] {
       const Case c{find_query("box_box_info"), Scalar::float64, two_boxes(4), "test", 0, 0, {}};
       std::vector<double> given{1.5, 1, 1, 1, 1, 1, 4, 0, 0};
       for (int twice = 0; twice < 2; ++twice) given.insert(given.end(), {1, 0, 0, 0, 1, 0, 0, 0, 1});
       for (int twice = 0; twice < 2; ++twice) given.insert(given.end(), {4, 0, 0});
       return report(c, answer(true, given));
     },
     Verdict::violates_contract, Disagreement::wrong_size, "stooge gives half1 (1.5, 1, 1). Exactly, it is (1, 1, 1)"},
    {"wrong_direction",
     [] {
       const Case c{find_query("bounce_direction"),
                    Scalar::float64,
                    {0, 0, 1, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1},
                    "test",
                    0,
                    0,
                    {}};
       return report(c, answer(true, {0, 1, 0}));
     },
     Verdict::violates_contract, Disagreement::wrong_direction,
     "stooge gives direction (0, 1, 0). Exactly, it is (0, 0, 1)"},
    {"wrong_weight",
     [] {
       const Case c{find_query("point_in_triangle"),
                    Scalar::float64,
                    {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, -1, 0.25, 0.25, 0},
                    "test",
                    0,
                    0,
                    {}};
       return report(c, answer(true, {0.25, 0.5, 0.25}));
     },
     Verdict::violates_contract, Disagreement::wrong_weight,
     "stooge gives weights (0.25, 0.5, 0.25). Exactly, it is (0.5, 0.25, 0.25)"},
    {"wrong_flag",
     [] {
       const Case c{
           find_query("ray_aabox"), Scalar::float64, {-3, 0, 0, 1, 0, 0, -1, -1, -1, 1, 1, 1}, "test", 0, 0, {}};
       return report(c, answer(true, {1, -1, 0, 0}));
     },
     Verdict::violates_contract, Disagreement::wrong_flag, "stooge gives inside 1. Exactly, it is 0"},
    {"wrong_index",
     [] {
       const Case c{find_query("closest_point_triangle_perimeter_edges"),
                    Scalar::float64,
                    {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.5, -1, 0},
                    "test",
                    0,
                    0,
                    {}};
       return report(c, answer(true, {0.5, 0, 0, 1}));
     },
     Verdict::violates_contract, Disagreement::wrong_index, "stooge gives edge 1. Exactly, it is 0"},
    {"not_finite", [] { return report(flight(0), hit(4, std::nan(""))); }, Verdict::violates_contract,
     Disagreement::not_finite, "stooge answers, but location.y is NaN. Exactly, it is a hit at time 4."},
    {"not_unit", [] { return report(flight(0), hit(4, 0, -1.25)); }, Verdict::violates_contract, Disagreement::not_unit,
     "stooge gives a normal of length 1.25"},
    {"negative_time", [] { return report(overlapping(), hit(-1.5e-8)); }, Verdict::violates_contract,
     Disagreement::negative_time,
     "stooge gives time -1.5e-08. Exactly, it is 0: time is off by 1.5e-08 (in which the motion covers 3e-08, 2e-08 of "
     "the largest position or size)"},
    {"wrong_combination",
     [] {
       return report(overlap(0), answer(true, {2, 1, 0, 0, 0, 1, 0}));
     },
     Verdict::violates_contract, Disagreement::wrong_combination,
     "stooge gives members that no right answer has together"},
    {"exceeds_the_measure", [] { return report(flight(0), hit(4.5), {}); }, Verdict::exceeds_measure,
     Disagreement::wrong_time,
     "It promises nothing; the measure is a backward error of at most 0.0001 times the largest number in each group."},
    {"below_the_measure", [] { return report(flight(0), hit(4.00001), {}); }, Verdict::not_proved,
     Disagreement::wrong_time, "It promises nothing, and is not proved to differ by more than the measure."},
    {"all_wrong_members", [] { return report(flight(0), hit(4.5, 0.25, 0, 1)); }, Verdict::violates_contract,
     Disagreement::wrong_normal,
     "It also gives a wrong time, by more than 2^47 epsilon and gives a wrong location, by more than 2^45 epsilon"},
    {"a_leaving_touch",
     [] {
       Case c = flight(0);
       c.values[0] = -2, c.values[4] = -2;
       return report(c, hit(0));
     },
     Verdict::violates_contract, Disagreement::false_hit,
     "Exactly, it is a miss, because the sphere starts in touch with the box and moves away."},
    {"a_point_that_starts_inside",
     [] {
       Case c = flight(0);
       c.values[0] = 0, c.values[3] = 0;
       return report(c, hit(0));
     },
     Verdict::violates_contract, Disagreement::false_hit,
     "Exactly, it is a miss, because the sphere starts inside the box."},
    {"a_time_beyond_the_largest_number",
     [] {
       const Case c{find_query("moving_point_plane"),
                    Scalar::float64,
                    {0, 0, 1e200, 0, 0, -1e-200, 0, 0, 1, 0},
                    "test",
                    0,
                    0,
                    {}};
       return report(c, answer(true, {infinity, 0, 0, 0, 0, 0, 1}));
     },
     Verdict::violates_contract, Disagreement::false_hit,
     "stooge says that the point hits the plane at time Infinity. Exactly, it is a miss, because the contact comes at "
     "a "
     "time beyond the largest number."},
    {"a_normal_without_direction",
     [] {
       return report(overlapping_spheres(1), answer(true, {1, 0, 0, 0, 1, 0, 0}));
     },
     Verdict::violates_contract, Disagreement::wrong_normal,
     "stooge gives normal (0, 0, 0), which has no direction. Exactly, it is (1, 0, 0)"},
    {"no_direction_where_any_is_right",
     [] {
       return report(overlapping_spheres(0), answer(true, {2, 0, 0, 0, 0, 0, 0}), {.backward = 4});
     },
     Verdict::violates_contract, Disagreement::wrong_normal,
     "stooge gives normal (0, 0, 0), which has no direction. Any unit vector is right there"},
    {"a_number_that_is_cut",
     [] {
       const Case c{
           find_query("sphere_sphere_penetration"), Scalar::float64, {0, 0, 0, 0.2, 0, 0, 0, 0.1}, "test", 0, 0, {}};
       return report(c, answer(true, {0.3, 0, 0, 1, 0, 0, 0.2}));
     },
     Verdict::agrees, Disagreement::none, "Exactly, they touch or overlap, depth ≈0.30000000000000004."},
    {"the_normal_of_a_face",
     [] {
       const Case c{find_query("moving_point_box"),
                    Scalar::float64,
                    {-3, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1},
                    "test",
                    0,
                    0,
                    {}};
       return report(c, answer(true, {2, -1, 0, 0, 0, 1, 0}));
     },
     Verdict::violates_contract, Disagreement::wrong_normal,
     "stooge gives normal (0, 1, 0). Exactly, it is (-1, 0, 0): normal.y is off by 1, 4.5e+15 units in the last place"},
    {"the_border_of_a_precondition", report_at_a_border, Verdict::not_proved, Disagreement::false_hit,
     "Exactly, it is a miss. This is proved for exactly these numbers; nothing is proved for the numbers next to them, "
     "which may break a precondition: it requires a start outside"},
    {"parallel_axes",
     [] {
       const Case c{find_query("box_box_parallel_axis"),
                    Scalar::float64,
                    {0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 5, 0, 0, 1, 1, 1, 0, 0, 0, 1, 0x1p-10},
                    "test",
                    0,
                    0,
                    {}};
       return report(c, answer(false, {-1, -1}));
     },
     Verdict::violates_contract, Disagreement::false_miss,
     "stooge says that no axis of box 1 is parallel to one of box 2. Exactly, the answer is yes."},
    {"a_zero_with_a_sign",
     [] {
       return report(overlap(1.5), answer(true, {-0.0, -1, 0, 0, 1, 0, 0}));
     },
     Verdict::violates_contract, Disagreement::wrong_depth, "stooge gives depth 0. Exactly, it is 0.5"},
    {"the_nearest_of_several",
     [] {
       return report(overlap(0), answer(true, {2, 0, 1, 0, 0, 1.5, 0}));
     },
     Verdict::violates_contract, Disagreement::off_surface,
     "The nearest exact answer is (0, 1, 0): contact.y is off by 0.5"},
    {"out_of_domain", [] { return report(flight(0), miss(), {.backward = 4, .lowest = 10, .highest = 20}); },
     Verdict::out_of_domain, Disagreement::none,
     "stooge promises nothing for numbers of this size: the largest number of each group must be 0 or lie between 2^10 "
     "and 2^20."},
    {"cannot_answer", [] { return report(flight(0), Answer::without(Answer::Status::cannot_answer, "too fast")); },
     Verdict::cannot_answer, Disagreement::none, "stooge says that it cannot answer this case: too fast."},
    {"broke", [] { return report(flight(0), Answer::without(Answer::Status::broke, "no answer within 2 s")); },
     Verdict::broke, Disagreement::none,
     "stooge gave no answer: no answer within 2 s. Exactly, it is a hit at time 4."},
    {"not_asked", unasked_report, Verdict::not_asked, Disagreement::none,
     "stooge is not asked: it requires a velocity that is not zero. Exactly, "},
};

class EveryKind : public testing::TestWithParam<Expectation> {};

TEST_P(EveryKind, IsJudgedExplainedAndValid) {
  const Expectation& e = GetParam();
  const Report r = e.make();
  EXPECT_EQ(name_of(r.finding.verdict), name_of(e.verdict));
  EXPECT_EQ(name_of(r.finding.disagreement), name_of(e.disagreement));
  EXPECT_NE(explanation(r).find(e.says), std::string::npos) << explanation(r);
  EXPECT_EQ(headline(r).find("stooge"), 0u);
  const nlohmann::json j = nlohmann::json::parse(report_to_json(r).dump());
  EXPECT_EQ(complaints(j, "report.schema.json"), "");
  EXPECT_EQ(case_from_json({{"query", j["query"]}, {"scalar", j["scalar"]}, {"inputs", j["inputs"]}}, "report").values,
            r.question.values);
}

INSTANTIATE_TEST_SUITE_P(Report, EveryKind, testing::ValuesIn(expectations),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Report, CoversEveryVerdictAndDisagreement) {
  for (int v = 0; v < verdict_count; ++v) {
    EXPECT_TRUE(std::any_of(std::begin(expectations), std::end(expectations), [&](const Expectation& e) {
      return int(e.verdict) == v;
    })) << name_of(Verdict(v));
  }
  for (int d = 0; d <= int(Disagreement::not_unit); ++d) {
    EXPECT_TRUE(std::any_of(std::begin(expectations), std::end(expectations), [&](const Expectation& e) {
      return int(e.disagreement) == d;
    })) << name_of(Disagreement(d));
  }
}

/// A right answer is listed once, however many branches of the oracle meet it.
TEST(Report, ListsARightAnswerOnce) {
  for (const Case& c : {flight(0), overlapping(), overlap(0), overlap(1.5), nearest()}) {
    const std::vector<Alternative> all = truth_of(c).alternatives;
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(all[i] == all[k]) << c.query->name;
    }
  }
}

TEST(Report, SaysOfEachMemberWhatIsProved) {
  const auto j = report_to_json(report(flight(0), hit(4.5, 0.25)));
  const auto& members = j["finding"]["members"];
  ASSERT_EQ(members.size(), 2u);
  EXPECT_EQ(members[0]["member"], "time");
  EXPECT_EQ(members[0]["forward"]["absolute"], 0.5);
  EXPECT_EQ(members[1]["member"], "location");
  EXPECT_EQ(members[1]["forward"]["field"], "location.y");
  EXPECT_TRUE(members[1]["backward"]["moved"].contains("position"));
  EXPECT_EQ(j["measure"], nullptr);
}

TEST(Report, NamesTheMeasureThatItsSubjectIsHeldTo) {
  const auto j = report_to_json(report(flight(0), hit(4.5), {}));
  EXPECT_EQ(j["measure"]["error"], Measure::usual);
  EXPECT_EQ(complaints(nlohmann::json::parse(j.dump()), "report.schema.json"), "");
}

TEST(Report, GivesAMissNoTime) {
  const auto j = report_to_json(report(flight(0), miss()));
  EXPECT_EQ(j["answer"].dump(), R"({"status":"answered","yes":false,"values":{}})");
  const auto truth = report_to_json(report(flight(5), hit(4)))["truth"];
  EXPECT_EQ(truth["alternatives"].dump(), R"([{"yes":false,"values":{}}])");
}

TEST(Report, WritesNumbersThatAreNotFiniteAsWords) {
  const auto j = report_to_json(report(flight(0), hit(4, std::nan(""))));
  EXPECT_EQ(j["answer"]["values"]["location"].dump(), R"([-1.0,"NaN",0.0])");
}

TEST(Report, ListsTheConeWhereManyNormalsAreRight) {
  // The ball's center is the box's own: every face is equally near but for the radius; start at a corner.
  Case corner = flight(0);
  corner.values[0] = -1, corner.values[1] = 1, corner.values[2] = 1, corner.values[3] = 0;
  const auto j = report_to_json(report(corner, miss()));
  ASSERT_FALSE(j["truth"]["alternatives"].empty());
  EXPECT_TRUE(j["truth"]["alternatives"][0].contains("normal_cone")) << j["truth"].dump(2);
  EXPECT_EQ(complaints(nlohmann::json::parse(j.dump()), "report.schema.json"), "");
}

TEST(Report, HasAnIdThatDependsOnTheCaseAndTheFault) {
  const std::string id = id_of(report(flight(0), miss()));
  EXPECT_EQ(id, id_of(report(flight(0), miss())));
  EXPECT_NE(id, id_of(report(flight(0.5), miss())));
  EXPECT_NE(id, id_of(report(flight(0), hit(4.5))));
}

/// The schema must refuse every mutilated report; otherwise it checks nothing.
TEST(ReportSchema, RejectsBrokenDocuments) {
  const nlohmann::json good = nlohmann::json::parse(report_to_json(report(flight(0), hit(4.5))).dump());
  ASSERT_EQ(complaints(good, "report.schema.json"), "");
  for (const auto& member : good.items()) {
    nlohmann::json broken = good;
    broken.erase(member.key());
    EXPECT_NE(complaints(broken, "report.schema.json"), "") << "without " << member.key();
    broken = good;
    broken[member.key()] = nlohmann::json::array({1.5});
    EXPECT_NE(complaints(broken, "report.schema.json"), "") << member.key() << " an array";
  }
  const auto reject = [&](const char* pointer, const nlohmann::json& value) {
    nlohmann::json broken = good;
    broken[nlohmann::json::json_pointer(pointer)] = value;
    EXPECT_NE(complaints(broken, "report.schema.json"), "") << pointer << " = " << value;
  };
  reject("/surplus", 1);
  reject("/schema", 3);
  reject("/id", "2f53d141f79");
  reject("/answer/values/time", nullptr);
  reject("/answer/values/time", "infinite");
  reject("/answer/status", "silent");
  reject("/finding/verdict", "wrong");
  reject("/finding/disagreement", "false");
  reject("/finding/backward/above_epsilon", -1);
  reject("/finding/backward/surplus", 1);
  reject("/truth/alternatives", nlohmann::json::array());
  reject("/truth/alternatives/0/values/time", nlohmann::json::array({1.0, 2.0, 3.0, 4.0}));
  reject("/contract/backward_epsilon", -1);
  reject("/subject/scalar", "half");
}

/// A ball around the center of a cube has six right answers, one for each face.
TEST(ReplayText, HasTheVerdictFirstAndOfManyRightAnswersTheNearest) {
  const Case question = overlap(0);
  const Truth truth = truth_of(question);
  ASSERT_EQ(truth.alternatives.size(), 6u);
  const Alternative& last = truth.alternatives.back();
  Answer given = answer(true, {});
  for (std::size_t i = 0; i < last.count; ++i) given.values[i] = last.values[i].low;
  given.values[0] += 1;  // the depth
  const std::string text = replay_text({question, "file", truth, {report(question, given)}, {}});
  const std::size_t exact = text.find("\nTruth: ");
  ASSERT_NE(exact, std::string::npos) << text;
  EXPECT_LT(text.find("violates contract"), exact) << text;
  EXPECT_LT(text.find("The nearest exact answer is 2"), exact) << text;
  EXPECT_NE(
      text.find("  or one of 3 more right answers; these are nearest to the wrong ones above, and --json lists all\n",
                exact),
      std::string::npos)
      << text;
  const std::string first = text.substr(exact, text.find("  or\n", exact) - exact);
  const std::string alone = replay_text({question, "file", {true, truth.decided_by, {last}, 1, ""}, {}, {}});
  const std::size_t begin = alone.find("  depth");
  EXPECT_NE(first.find(alone.substr(begin, alone.find("  The decision", begin) - begin)), std::string::npos) << text;
}

}  // namespace
}  // namespace nearmiss
