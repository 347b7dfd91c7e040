/// Causes of findings: mistakes are planted, one of each kind, and each is named, with a test that passed as evidence.
#include <gtest/gtest.h>

#include <cfenv>
#include <chrono>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "corpus/files/source_folder.hpp"
#include "corpus/generator/fit.hpp"
#include "corpus/generator/generator.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/subject/provenance.hpp"
#include "reports/tests/program.hpp"
#include "reports/tests/schema.hpp"
#include "reports/triage/geometry/magnitudes.hpp"
#include "reports/triage/geometry/quantities.hpp"
#include "reports/triage/geometry/ratios.hpp"
#include "reports/triage/hypotheses/cause_of.hpp"
#include "reports/triage/hypotheses/readings.hpp"
#include "reports/triage/hypotheses/regions.hpp"
#include "reports/triage/hypotheses/written_constant.hpp"
#include "reports/triage/trials/border.hpp"
#include "reports/triage/trials/crossings.hpp"
#include "reports/triage/trials/scales.hpp"

namespace nearmiss {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Values = std::span<const double>;

/// A right answer, from the certified tier.
Answer right(const char* query, Values values) {
  static const Subject certified = [] {
    for (const Subject& own : own_subjects_in_process()) {
      if (own.name == "collide-certified-double") return own;
    }
    throw std::logic_error("no certified tier");
  }();
  return certified.offering(query).answer(values);
}

Subject planted(const char* query, Answer (*answer)(Values), Scalar scalar = Scalar::float64,
                collide::Contract contract = {.backward = 0x1p20}) {
  Subject s{.name = "planted", .version = "1", .scalar = scalar, .offerings = {}};
  s.offerings.push_back({query, Offer::answers, "", contract, answer, {}});
  return s;
}

Case case_asking(const char* query, std::vector<double> values, Scalar scalar = Scalar::float64) {
  return {find_query(query), scalar, std::move(values), "test", 0, 0, {}};
}

Cause cause(const Subject& subject, const Case& question, const CauseLimits& limits = {.time = std::chrono::hours(1)}) {
  Workers workers;
  const Report report = examine(question, subject, workers);
  EXPECT_TRUE(is_bad(report.finding)) << "the mistake is not found";
  return cause_of(report, subject, limits, workers);
}

/// The first generated case that counts against the subject and for which `wanted` holds.
template <class Wanted>
Case first_finding(const Subject& s, const Wanted& wanted) {
  Workers workers;
  const Query& query = *find_query(s.offerings[0].query);
  for (std::uint64_t i = 0; i < 5000; ++i) {
    Case c;
    generate_inside(c, query, s.scalar, 1, i, {});
    if (!has_extreme_mutator(c) && wanted(c) && is_bad(examine(c, s, workers).finding)) return c;
  }
  throw std::logic_error("no finding");
}
Case first_finding(const Subject& s) {
  return first_finding(s, [](const Case&) { return true; });
}

bool changes_with_the_rounding(const Subject& s, const Case& c) {
  static Workers workers;
  std::size_t yes = 0;
  constexpr Rounding directed[] = {Rounding::downward, Rounding::upward, Rounding::toward_zero};
  for (const Rounding r : directed) {
    workers.send(s, {&c, 1}, r);
    yes += workers.receive(s).front().yes;
  }
  return yes > 0 && yes < std::size(directed);
}

std::string text_of(const Cause& c) { return cause_text(c); }

// sphere_sphere_overlap: center1 x y z, radius1, center2 x y z, radius2.

double gap(Values q) { return std::hypot(q[0] - q[4], q[1] - q[5], q[2] - q[6]) - q[3] - q[7]; }

Answer with_slack(Values q) {
  Answer a;
  a.yes = gap(q) <= 1e-6;
  return a;
}

TEST(Cause, AbsoluteToleranceOfAGap) {
  const Subject s = planted("sphere_sphere_overlap", with_slack, Scalar::float64, {.backward = 8});
  const Cause c = cause(s, case_asking("sphere_sphere_overlap", {0.1, 0.2, 0.3, 0.5, 1.3, 0.2, 0.3, 0.7 - 4.1e-7}));
  EXPECT_EQ(c.kind, CauseKind::absolute_tolerance) << text_of(c);
  EXPECT_EQ(c.key, "1e-6 length") << text_of(c);
  EXPECT_NE(c.text.find("the gap or overlap"), std::string::npos) << text_of(c);
}

Answer blind_for_small(Values q) {
  Answer a = right("sphere_box_overlap", q);
  if (q[3] < 1e-3) a.yes = false;
  return a;
}

TEST(Cause, AbsoluteToleranceOfASize) {
  const Subject s = planted("sphere_box_overlap", blind_for_small);
  const Cause c =
      cause(s, case_asking("sphere_box_overlap", {0.5, 0.25, 0.125, 3e-4, 0.25, 0, 0, 1, 2, 3, 0, 0, 0.25, 1}));
  EXPECT_EQ(c.kind, CauseKind::absolute_tolerance) << text_of(c);
  EXPECT_EQ(c.key, "1e-3 length") << text_of(c);
  EXPECT_NE(c.text.find("sphere.radius"), std::string::npos) << text_of(c);
}

Answer with_relative_slack(Values q) {
  Answer a;
  a.yes = gap(q) <= 1e-9 * (q[3] + q[7]);
  return a;
}

TEST(Cause, RelativeToleranceOfAGap) {
  const Subject s = planted("sphere_sphere_overlap", with_relative_slack, Scalar::float64, {.backward = 8});
  const Cause c = cause(s, case_asking("sphere_sphere_overlap", {0.1, 0.2, 0.3, 0.5, 1.3, 0.2, 0.3, 0.7 - 4.1e-10}));
  EXPECT_EQ(c.kind, CauseKind::relative_tolerance) << text_of(c);
  EXPECT_EQ(c.key, "1e-9") << text_of(c);
}

/// Lines: point x y z, direction x y z, twice.
Answer nearly_parallel_is_parallel(Values q) {
  Answer a = right("closest_points_lines", q);
  const double x = q[4] * q[11] - q[5] * q[10], y = q[5] * q[9] - q[3] * q[11], z = q[3] * q[10] - q[4] * q[9];
  const double square = q[9] * q[9] + q[10] * q[10] + q[11] * q[11];
  const double sine = std::hypot(x, y, z) / (std::hypot(q[3], q[4], q[5]) * std::sqrt(square));
  if (sine == 0 || sine >= 1e-5) return a;
  const double t = ((q[0] - q[6]) * q[9] + (q[1] - q[7]) * q[10] + (q[2] - q[8]) * q[11]) / square;
  for (std::size_t k = 0; k < 3; ++k) a.values[k] = q[k], a.values[3 + k] = q[6 + k] + t * q[9 + k];
  return a;
}

TEST(Cause, RelativeToleranceOfASine) {
  const Subject s = planted("closest_points_lines", nearly_parallel_is_parallel);
  const Cause c = cause(s, case_asking("closest_points_lines", {0.1, 0.2, 0.3, 1, 2, 3, 1, -2, 0.5, 1.000004, 2, 3}));
  EXPECT_EQ(c.kind, CauseKind::relative_tolerance) << text_of(c);
  EXPECT_EQ(c.key, "1e-5") << text_of(c);
  EXPECT_NE(c.text.find("the sine of the angle between line1.direction and line2.direction"), std::string::npos)
      << text_of(c);
}

/// A false hit has no exact contact: the ratio is told from the given one.
Answer larger_triangle(Values q) {
  Answer a = right("moving_point_triangle", q);
  if (a.yes) return a;
  constexpr double larger = 1 + 3e-9;  // weights down to -1e-9
  std::vector<double> other(q.begin(), q.end());
  for (std::size_t k = 0; k < 3; ++k) {
    const double middle = (q[6 + k] + q[9 + k] + q[12 + k]) / 3;
    for (const std::size_t corner : {6, 9, 12}) other[corner + k] = middle + (q[corner + k] - middle) * larger;
  }
  return right("moving_point_triangle", other);
}

TEST(Cause, RelativeToleranceOfAFalseHit) {
  const Subject s = planted("moving_point_triangle", larger_triangle, Scalar::float64, {.backward = 64});
  const Cause c =
      cause(s, case_asking("moving_point_triangle", {0.3, -5e-10, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0.1, 0.1, 1, 0.05}));
  EXPECT_EQ(c.kind, CauseKind::relative_tolerance) << text_of(c);
  EXPECT_EQ(c.key, "1e-9") << text_of(c);
}

/// Any component of the velocity may be the one that is dropped.
Answer drops_small_components(Values q) {
  std::vector<double> other(q.begin(), q.end());
  const double largest = std::max({std::abs(q[3]), std::abs(q[4]), std::abs(q[5])});
  for (std::size_t k = 3; k < 6; ++k) {
    if (std::abs(q[k]) < 1e-9 * largest) other[k] = 0;
  }
  return right("moving_point_aabox", other);
}

TEST(Cause, RelativeToleranceOfAComponent) {
  const Subject s = planted("moving_point_aabox", drops_small_components, Scalar::float64, {.backward = 64});
  const Cause c = cause(s, case_asking("moving_point_aabox", {-3, 1 + 1e-9, 0.1, 1, -9e-10, 0.2, -1, -1, -1, 1, 1, 2}));
  EXPECT_EQ(c.kind, CauseKind::relative_tolerance) << text_of(c);
  EXPECT_EQ(c.key, "1e-9") << text_of(c);
}

/// Every wrong answer has a right one near by, but at no common ratio.
Answer wrong_in_a_half(Values q) {
  Answer a = right("sphere_sphere_overlap", q);
  if (q[0] + 2 * q[5] < 0.61803) a.yes = !a.yes;
  return a;
}

TEST(Cause, NoRelativeToleranceWhereNoRatioIsTheSame) {
  const Subject s = planted("sphere_sphere_overlap", wrong_in_a_half);
  const Cause c = cause(s, case_asking("sphere_sphere_overlap", {0.1, 0.7, 0.3, 0.7, 0.4, 0.2, 0.2, 0.6}));
  EXPECT_NE(c.kind, CauseKind::relative_tolerance) << text_of(c);
}

TEST(Crossings, LieWhereTheSubjectJumpsAndTheTruthStays) {
  const Subject s = planted("sphere_sphere_overlap", with_relative_slack, Scalar::float64, {.backward = 8});
  Workers workers;
  Trials trials(case_asking("sphere_sphere_overlap", {0.1, 0.2, 0.3, 0.5, 1.3, 0.2, 0.3, 0.7 - 4.1e-10}), s, {},
                workers);
  const std::vector<Crossing> crossings = crossings_of(trials, trials.base().question, {});
  ASSERT_FALSE(crossings.empty());
  for (const Crossing& x : crossings) {
    const auto share = [](const Case& c) { return gap(c.values) / (c.values[3] + c.values[7]); };
    constexpr double bisected = 1e-12;  // the bisection ends at a 2^-11 of a move of at most 1e-9
    EXPECT_NEAR(share(x.at_wrong), 1e-9, bisected) << x.number;
    EXPECT_NEAR(share(x.at_right.question), 1e-9, bisected) << x.number;
    EXPECT_FALSE(exact_decision(x.at_wrong)) << x.number;
  }
}

TEST(WrittenConstants, AreRoundInTenOrTwo) {
  const auto text = [](double x) {
    const auto constant = written_constant(x, x, 1.01);
    return constant ? constant->text : "";
  };
  EXPECT_EQ(text(1.0005e-6), "1e-6");
  EXPECT_EQ(text(0x1.001p-23), "2^-23");
  EXPECT_EQ(text(4.99e-4), "5e-4");
  EXPECT_EQ(text(3.3e-6), "");
}

TEST(Ratios, AreOfOneFamilyWhereOneLoopComparesThem) {
  const Ratios ratios(case_asking("moving_point_aabox", {-3, 1, 0.1, 1, -2, 0.2, -1, -1, -1, 1, 1, 2}));
  std::map<std::string, std::vector<std::string>> families;
  for (std::size_t i = 0; i < ratios.size(); ++i) families[ratios.family(i)].push_back(ratios.name(i));
  const auto of_velocity = std::find_if(families.begin(), families.end(), [](const auto& f) {
    return f.second.front() == "component x of velocity over the largest";
  });
  ASSERT_NE(of_velocity, families.end());
  EXPECT_EQ(of_velocity->second, (std::vector<std::string>{"component x of velocity over the largest",
                                                           "component y of velocity over the largest",
                                                           "component z of velocity over the largest"}));
}

TEST(Magnitudes, KeepTheDigitsOfAGap) {
  const double radius = 0.7 - 0x1p-40;
  const Case c = case_asking("sphere_sphere_overlap", {0, 0, 0, 0.5, 1.2, 0, 0, radius});
  const Magnitudes all = magnitudes_of(c);
  const auto gap = std::find_if(all.lengths.begin(), all.lengths.end(), [](const Magnitude& m) {
    return m.name == "the gap between sphere1.center and sphere2";
  });
  ASSERT_NE(gap, all.lengths.end());
  constexpr double rounding = 4 * 0x1p-63;  // of a square, a root and two differences below 2 in extended precision
  EXPECT_NEAR(double(gap->value - (static_cast<long double>(1.2) - 0.5L - radius)), 0, rounding);
}

// moving_sphere_box: the answer is a time, a location and a normal.

template <int sign>
Answer turned_normal(Values q) {
  Answer a = right("moving_sphere_box", q);
  for (std::size_t i = 4; i < 7; ++i) a.values[i] *= sign;
  return a;
}
Answer distance_for_time(Values q) {
  Answer a = right("moving_sphere_box", q);
  a.values[0] *= std::hypot(q[4], q[5], q[6]);
  return a;
}
Answer center_for_contact(Values q) {
  Answer a = right("moving_sphere_box", q);
  for (std::size_t k = 0; a.yes && k < 3; ++k) a.values[1 + k] = q[k] + q[4 + k] * a.values[0];
  return a;
}
std::string convention_of(Answer (*answer)(Values)) {
  const Subject s = planted("moving_sphere_box", answer, Scalar::float64, {.backward = 0x1p20, .unit = 0x1p20});
  const Cause c = cause(s, first_finding(s));
  EXPECT_EQ(c.kind, CauseKind::convention) << text_of(c);
  return c.key;
}

TEST(Cause, Conventions) {
  EXPECT_EQ(convention_of(turned_normal<-1>), "normal reversed");
  EXPECT_EQ(convention_of(turned_normal<2>), "normal not of unit length");
  EXPECT_EQ(convention_of(distance_for_time), "distance in place of time");
  EXPECT_EQ(convention_of(center_for_contact), "center in place of the contact");
}

/// The sign of the depth decides.
Answer negative_for_an_overlap(Values q) {
  Answer a = right("sphere_sphere_penetration", q);
  if (a.yes) a.values[0] = -a.values[0];
  a.yes = a.values[0] >= 0;
  return a;
}

TEST(Cause, DepthOfTheOtherSign) {
  const Subject s = planted("sphere_sphere_penetration", negative_for_an_overlap);
  const Cause c = cause(s, first_finding(s));
  EXPECT_EQ(c.kind, CauseKind::convention) << text_of(c);
  EXPECT_EQ(c.key, "depth of the other sign");
}

Answer strict(Values q) {
  Answer a = right("sphere_sphere_overlap", q);
  const double x = q[0] - q[4], y = q[1] - q[5], z = q[2] - q[6], r = q[3] + q[7];
  if (x * x + y * y + z * z == r * r) a.yes = false;
  return a;
}

TEST(Cause, StrictInPlaceOfClosed) {
  const Subject s = planted("sphere_sphere_overlap", strict, Scalar::float64, {.backward = 8, .exact_decisions = true});
  const Cause c = cause(s, case_asking("sphere_sphere_overlap", {0, 0, 0, 1, 3, 4, 0, 4}));
  EXPECT_EQ(c.kind, CauseKind::convention) << text_of(c);
  EXPECT_EQ(c.key, "strict instead of closed");
}

Answer upright(Values q) {
  std::vector<double> values(q.begin(), q.end());
  std::fill_n(values.begin() + 13, 3, 0.0);
  values[16] = 1;
  return right("moving_sphere_box", values);
}

TEST(Cause, UnsupportedRotation) {
  const Subject s = planted("moving_sphere_box", upright);
  const Cause c = cause(s, first_finding(s));
  EXPECT_EQ(c.kind, CauseKind::unsupported) << text_of(c);
  EXPECT_EQ(c.key, "rotation ignored");
}

Answer throws_for_points(Values q) {
  if (q[3] == 0) return Answer::without(Answer::Status::broke, "exception: no support point");
  return right("moving_sphere_box", q);
}

TEST(Cause, UnsupportedRegion) {
  const Subject s = planted("moving_sphere_box", throws_for_points);
  const Cause c = cause(s, first_finding(s));
  EXPECT_EQ(c.kind, CauseKind::unsupported) << text_of(c);
  EXPECT_EQ(c.key, "sphere.radius of zero");
}

/// Squares of floats overflow above 2^64, and the comparison of two infinities is a hit.
Answer squares_in_float(Values q) {
  volatile float x = float(q[0]) - float(q[4]), y = float(q[1]) - float(q[5]), z = float(q[2]) - float(q[6]),
                 r = float(q[3]) + float(q[7]);
  Answer a;
  a.yes = x * x + y * y + z * z <= r * r;
  return a;
}

TEST(Cause, OverflowOfAProduct) {
  const Subject s = planted("sphere_sphere_overlap", squares_in_float, Scalar::float32);
  const Cause c =
      cause(s, case_asking("sphere_sphere_overlap", {0, 0, 0, 0x1p70, 0x1p75, 0x1p73, 0, 0x1p71}, Scalar::float32));
  EXPECT_EQ(c.kind, CauseKind::overflow) << text_of(c);
}

TEST(Cause, UnderflowOfAProduct) {
  const Subject s = planted("sphere_sphere_overlap", squares_in_float, Scalar::float32);
  const Cause c =
      cause(s, case_asking("sphere_sphere_overlap", {0, 0, 0, 0x1p-90, 0x1p-80, 0x1p-82, 0, 0x1p-91}, Scalar::float32));
  EXPECT_EQ(c.kind, CauseKind::underflow) << text_of(c);
}

/// The discriminant of balls that are far away cancels in float.
Answer cancels(Values q) {
  Answer a = right("sphere_sphere_overlap", q);  // first: it restores the flags of exceptions
  volatile float xx = float(q[0]) * float(q[0]), yy = float(q[4]) * float(q[4]), xy = float(q[0]) * float(q[4]);
  volatile float r = float(q[3]) + float(q[7]);
  volatile float square = xx + yy;
  square = square - 2 * xy;
  if (q[1] == q[5] && q[2] == q[6]) a.yes = square <= r * r;
  return a;
}

TEST(Cause, RoundingThatIsUnstable) {
  const Subject s = planted("sphere_sphere_overlap", cancels, Scalar::float32, {.backward = 64});
  const Cause c = cause(s, case_asking("sphere_sphere_overlap",
                                       {float(10007.37), 1, 2, 0.25, float(10008.61), 1, 2, 0.25}, Scalar::float32));
  EXPECT_EQ(c.kind, CauseKind::rounding) << text_of(c);
}

/// The sign of one term is wrong.
Answer wrong_sign(Values q) {
  Answer a;
  a.yes = std::hypot(q[0] - q[4], q[1] + q[5], q[2] - q[6]) <= q[3] + q[7];
  return a;
}

TEST(Cause, LogicOfAWrongSign) {
  const Subject s = planted("sphere_sphere_overlap", wrong_sign);
  const Cause c = cause(s, case_asking("sphere_sphere_overlap", {0.1, 1.7, 0.3, 0.7, 0.4, 1.1, 0.2, 0.6}));
  EXPECT_EQ(c.kind, CauseKind::logic) << text_of(c);
  EXPECT_NE(text_of(c).find("in every rounding mode"), std::string::npos) << text_of(c);
}

/// A program has no other rounding modes, so nothing is said of them.
TEST(Cause, LogicOfAProgramIsNotSaidToStayInOtherRoundings) {
  if (python().empty()) GTEST_SKIP() << "this system has no Python";
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "program");
  std::filesystem::copy(source_folder() + "/impl/program/nearmiss.py", folder / "program/nearmiss.py");
  const std::string file = folder.file("program/wrong.py", R"(import math
import nearmiss
def meet(q):
    a, b = q.sphere1.center, q.sphere2.center
    return math.hypot(a[0] - b[0], a[1] + b[1], a[2] - b[2]) <= q.sphere1.radius + q.sphere2.radius
nearmiss.answer(name="wrong", scalar="double", queries={"sphere_sphere_overlap": meet})
)");
  const std::vector<std::string> program{"--command", python() + " " + file, "--subject", "wrong"};
  const auto with_program = [&](std::vector<std::string> words) {
    words.insert(words.end(), program.begin(), program.end());
    return nearmiss(words);
  };
  const std::filesystem::path run = folder / "run";
  ASSERT_EQ(with_program({"run", "--cases", "200", "--seed", "1", "--out", run.string()}).exit_code, 1);
  const json index = json::parse(read_file(run / "index.json"));
  const std::string finding = (run / index.at("reports").at(0).at("file").get<std::string>()).string();
  const Ran ran = with_program({"explain", "--json", "--out", (folder / "explained").string(), finding});
  ASSERT_EQ(ran.exit_code, 1) << ran.err;
  const json cause = json::parse(ran.out).at(0).at("cause");
  EXPECT_EQ(cause["kind"], "logic") << ran.out;
  EXPECT_NE(cause["evidence"].dump().find("It cannot be asked in other rounding modes."), std::string::npos) << ran.out;
  EXPECT_EQ(cause["text"].get<std::string>().find("rounding"), std::string::npos) << ran.out;
}

/// The back of a triangle is a miss. The case lies on the plane of the triangle, but for a rounding error, so that a
/// rounding mode changes its answer by chance; other cases with the finding do not.
Answer front_alone(Values q) {
  const volatile double x = q[0] - q[4], y = q[1] - q[5], z = q[2] - q[6];
  const volatile double u = q[7] - q[4], v = q[10] - q[4], s = q[8] - q[5], t = q[11] - q[5], m = q[9] - q[6],
                        n = q[12] - q[6];
  const volatile double a = s * n, b = m * t, c = m * v, d = u * n, e = u * t, f = s * v;
  const volatile double p = a - b, r = c - d, w = e - f, i = p * x, k = r * y, l = w * z, ik = i + k;
  const bool is_behind = ik + l < 0;
  Answer all = right("sphere_triangle_overlap", q);
  if (is_behind) all.yes = false;
  return all;
}

TEST(Cause, LogicOfACaseOnABorderIsNoRounding) {
  const Subject s = planted("sphere_triangle_overlap", front_alone);
  const Cause c = cause(s, first_finding(s, [&](const Case& other) { return changes_with_the_rounding(s, other); }));
  EXPECT_NE(c.kind, CauseKind::rounding) << text_of(c);
}

/// Samples the motion in equal steps, which are longer than the spheres.
Answer samples(Values q) {
  Answer a;
  a.yes = false;
  a.values[0] = INFINITY;
  constexpr int steps = 64;
  const double step = 3.78 * (q[3] + q[10]) / std::hypot(q[4], q[5], q[6]);
  for (int i = 0; i <= steps && !a.yes; ++i) {
    const double t = step * i;
    const double at[] = {q[0] + q[4] * t, q[1] + q[5] * t, q[2] + q[6] * t, q[3], q[7], q[8], q[9], q[10]};
    a.yes = gap(at) <= 0;
  }
  if (a.yes) a = right("moving_sphere_sphere", q);
  return a;
}

TEST(Cause, TooFewStepsAlongAMotion) {
  const Subject s = planted("moving_sphere_sphere", samples);
  const Cause c =
      cause(s, case_asking("moving_sphere_sphere", {-20.3, 0.1, 0.2, 0.4, 1.7, 0.1, 0, 1.9, 1.3, 0.1, 0.5}));
  EXPECT_EQ(c.kind, CauseKind::iteration_limit) << text_of(c);
  EXPECT_EQ(c.key, "steps along the motion");
}

/// The same, but it has no answer where the gap at the start is of some size.
Answer samples_where_it_can(Values q) {
  const double start[] = {q[0], q[1], q[2], q[3], q[7], q[8], q[9], q[10]};
  const bool can = gap(start) < 2 || gap(start) > 6;
  return can ? samples(q) : Answer::without(Answer::Status::cannot_answer, "not at this distance");
}

/// "Cannot answer" is neither right nor wrong: it is left out of what is counted.
TEST(Cause, CountsNoCaseWithoutAnAnswer) {
  const Case c = case_asking("moving_sphere_sphere", {-20.3, 0.1, 0.2, 0.4, 1.7, 0.1, 0, 1.9, 1.3, 0.1, 0.5});
  const auto counted = [&](Answer (*answer)(Values)) {
    for (const Evidence& e : cause(planted("moving_sphere_sphere", answer), c).evidence) {
      if (e.result.starts_with("The finding has ended in "))
        return std::stoul(e.result.substr(e.result.find(" of ") + 4));
    }
    ADD_FAILURE() << "the motion did not begin later";
    return 0ul;
  };
  const std::size_t all = counted(samples), answered = counted(samples_where_it_can);
  EXPECT_LT(answered, all);
  EXPECT_GT(answered, all / 2);
}

/// Bisects the time in 20 steps.
Answer bisects(Values q) {
  Answer a = right("moving_sphere_sphere", q);
  if (!a.yes || a.values[0] == 0) return a;
  const double longest = 2 * std::hypot(q[0] - q[7], q[1] - q[8], q[2] - q[9]) / std::hypot(q[4], q[5], q[6]);
  double low = 0, high = longest;
  for (int i = 0; i < 20; ++i) {
    const double middle = (low + high) / 2;
    (middle < a.values[0] ? low : high) = middle;
  }
  a.values[0] = high;
  return a;
}

TEST(Cause, TooFewHalvingsOfATime) {
  const Subject s = planted("moving_sphere_sphere", bisects);
  const Cause c =
      cause(s, case_asking("moving_sphere_sphere", {-20.3, 0.1, 0.2, 0.4, 1.7, 0.1, 0, 1.9, 1.3, 0.1, 0.5}));
  EXPECT_EQ(c.kind, CauseKind::iteration_limit) << text_of(c);
  EXPECT_EQ(c.key, "steps of the time");
}

/// The same for a point and an axis-aligned box, whose answer has the time after the place.
Answer bisects_entry(Values q) {
  static const std::size_t time = find_query("moving_point_aabox")->layout.at(Role::time)->begin;
  Answer a = right("moving_point_aabox", q);
  if (!a.yes) return a;
  const double longest = 2 * std::hypot(q[0] - q[6], q[1] - q[7], q[2] - q[8]) / std::hypot(q[3], q[4], q[5]);
  double low = 0, high = longest;
  for (int i = 0; i < 20; ++i) {
    const double middle = (low + high) / 2;
    (middle < a.values[time] ? low : high) = middle;
  }
  a.values[time] = high;
  return a;
}

TEST(Cause, TooFewHalvingsOfATimeWhereverTheAnswerHasIt) {
  const Subject s = planted("moving_point_aabox", bisects_entry);
  const Case question =
      case_asking("moving_point_aabox", {-20.3, 0.1, 0.2, 1.7, 0.1, 0, 1.4, -1.7, -1.4, 2.9, 1.9, 1.6});
  const Cause c = cause(s, question);
  EXPECT_EQ(c.kind, CauseKind::iteration_limit) << text_of(c);
  EXPECT_EQ(c.key, "steps of the time");
  const auto quantities = quantities_of(question, false);
  const auto contact = std::find_if(quantities.begin(), quantities.end(),
                                    [](const Quantity& x) { return x.name == "the time of the contact"; });
  ASSERT_NE(contact, quantities.end());
  EXPECT_NEAR(contact->value, (1.4 + 20.3) / 1.7, 1e-12);
}

Answer missed(Answer a) {
  a.yes = false;
  a.values = {};
  a.values[0] = INFINITY;
  return a;
}

/// Wrong where a velocity is zero along an axis.
Answer misses_along_axes(Values q) {
  Answer a = right("moving_sphere_sphere", q);
  return q[4] == 0 || q[5] == 0 || q[6] == 0 ? missed(a) : a;
}

TEST(Cause, UnsupportedMotionAlongAnAxis) {
  const Subject s = planted("moving_sphere_sphere", misses_along_axes);
  const Cause c = cause(s, case_asking("moving_sphere_sphere", {-3, 0.25, 0.5, 0.5, 1.5, 0.125, 0, 0, 0, 0, 1}));
  EXPECT_EQ(c.kind, CauseKind::unsupported) << text_of(c);
  EXPECT_EQ(c.key, "velocity with a component of zero");
}

/// Takes the sum of box and sphere for a box, which has corners that are not round.
Answer with_sharp_corners(Values q) {
  std::vector<double> sharp(q.begin(), q.end());
  for (const std::size_t half : {10, 11, 12}) sharp[half] += sharp[3];
  sharp[3] = 0;
  return right("moving_sphere_passes_box", sharp);
}

/// The code has no steps along the motion, although the answer depends on where the motion begins.
TEST(Cause, AFalseHitOfADecisionAboutAMotion) {
  const Subject s = planted("moving_sphere_passes_box", with_sharp_corners);
  const std::vector<double> case_values{6, -5, 0, 2, -6.25, -3, -3, -1, -12, -4, 3, 4, 1, 0, 0, 0, 1, 0.5, 0};
  const Cause c = cause(s, case_asking("moving_sphere_passes_box", case_values));
  EXPECT_EQ(c.kind, CauseKind::logic) << text_of(c);
  EXPECT_EQ(c.key, "sharp corners") << text_of(c);
}

/// Wrong where the first center lies in a plane of coordinates.
Answer wrong_in_a_plane(Values q) {
  Answer a = right("sphere_sphere_overlap", q);
  if (q[1] == 0) a.yes = !a.yes;
  return a;
}

TEST(Cause, NoLogicWhereTheFindingNeedsAZero) {
  const Subject s = planted("sphere_sphere_overlap", wrong_in_a_plane);
  const Cause c = cause(s, case_asking("sphere_sphere_overlap", {0.1, 0, 0.3, 0.7, 0.33003, 1.1, 0.2, 0.6}));
  EXPECT_EQ(c.kind, CauseKind::unexplained) << text_of(c);
}

/// Wrong where the ratio of two numbers lies in a narrow band: the tests see neither a region nor an instability.
Answer fickle(Values q) {
  Answer a = right("sphere_sphere_overlap", q);
  const double ratio = q[0] / q[4];
  if (0.30299 < ratio && ratio < 0.30301) a.yes = !a.yes;
  return a;
}

TEST(Cause, StaysUnexplainedWhereNoTestPasses) {
  const Subject s = planted("sphere_sphere_overlap", fickle);
  const Cause c = cause(s, case_asking("sphere_sphere_overlap", {0.1, 1.7, 0.3, 0.7, 0.33003, 1.1, 0.2, 0.6}));
  EXPECT_EQ(c.kind, CauseKind::unexplained) << text_of(c);
  EXPECT_FALSE(c.evidence.empty());
  EXPECT_NE(text_of(c).find("Cause: unexplained"), std::string::npos);
}

TEST(Cause, StopsAtItsLimits) {
  const Subject s = planted("sphere_sphere_overlap", wrong_sign);
  const Case question = case_asking("sphere_sphere_overlap", {0.1, 1.7, 0.3, 0.7, 0.4, 1.1, 0.2, 0.6});
  const Cause few = cause(s, question, {.questions = 100});
  EXPECT_EQ(few.kind, CauseKind::unexplained) << text_of(few);
  EXPECT_LE(few.questions, 100u);
  const Cause no_time = cause(s, question, {.time = std::chrono::seconds(0)});
  EXPECT_EQ(no_time.kind, CauseKind::unexplained) << text_of(no_time);
}

TEST(Cause, IsTheSameEachTime) {
  const Subject s = planted("moving_sphere_box", turned_normal<-1>);
  const Case question = first_finding(s);
  const Cause once = cause(s, question), twice = cause(s, question);
  EXPECT_EQ(text_of(once), text_of(twice));
  EXPECT_EQ(once.questions, twice.questions);
}

TEST(Cause, KernelsOfCollideAreComparedWithExactReals) {
  Subject s = planted("sphere_sphere_overlap", cancels, Scalar::float32, {.backward = 64});
  s.name = "collide-planted-float";
  s.own = true;
  const Cause c = cause(s, case_asking("sphere_sphere_overlap",
                                       {float(10007.37), 1, 2, 0.25, float(10008.61), 1, 2, 0.25}, Scalar::float32));
  EXPECT_EQ(c.kind, CauseKind::rounding) << text_of(c);
  EXPECT_NE(text_of(c).find("collide-certified-float"), std::string::npos) << text_of(c);
}

// The rounding of a host.

Answer tells_its_rounding(Values q) {
  volatile double one = 1, tiny = 0x1p-60 * q[3];
  Answer a;
  a.yes = one + tiny > 1;
  return a;
}

TEST(Cause, ASubjectIsAskedInEveryRoundingAndItsExceptionsAreSeen) {
  const Subject s = planted("sphere_sphere_overlap", tells_its_rounding);
  Workers workers;
  const Case inexact = case_asking("sphere_sphere_overlap", {0, 0, 0, 1, 5, 0, 0, 1}), exact = [&] {
    Case c = inexact;
    c.values[3] = 0;
    return c;
  }();
  for (const auto& [rounding, yes] : std::initializer_list<std::pair<Rounding, bool>>{{Rounding::its_own, false},
                                                                                      {Rounding::upward, true},
                                                                                      {Rounding::to_nearest, false},
                                                                                      {Rounding::downward, false},
                                                                                      {Rounding::toward_zero, false}}) {
    workers.send(s, {&inexact, 1}, rounding);
    EXPECT_EQ(workers.receive(s).front().yes, yes) << int(rounding);
    EXPECT_EQ(workers.raised(s, 0), rounding == Rounding::its_own ? 0 : raised_inexact);
  }
  workers.send(s, {&exact, 1}, Rounding::upward);
  workers.receive(s);
  EXPECT_EQ(workers.raised(s, 0), 0);
}

/// The plugin sets upward rounding when it is loaded, and answers yes where it rounds upward.
TEST(Cause, APluginIsAskedInOtherRoundingsThanItsOwn) {
  const TemporaryFolder folder;
  const Ran ran = nearmiss({"explain", "--plugin", plugin_file("sets_modes"), "--subject", "misbehaves", "--patience",
                            "0.02", "--json", "--out", folder.path().string(),
                            source_folder() + "/corpus/seeds/sphere_sphere_overlap/apart.json"});
  ASSERT_EQ(ran.exit_code, 1) << ran.err;
  const json report = json::parse(ran.out).at(0);
  EXPECT_EQ(report["finding"]["disagreement"], "false hit");
  EXPECT_EQ(report["cause"]["kind"], "rounding") << ran.out;
  EXPECT_NE(report["cause"]["evidence"].dump().find("The finding is there in 2"), std::string::npos) << ran.out;
}

/// Breaks where the square of a length leaves the range of double.
Answer breaks_far_out(Values q) {
  if (std::isinf(q[0] * q[0])) return Answer::without(Answer::Status::broke, "exception: no unit vector");
  return right("sphere_sphere_overlap", q);
}

TEST(Cause, OverflowThatBreaksTheSubject) {
  const Subject s = planted("sphere_sphere_overlap", breaks_far_out);
  const Cause c = cause(s, case_asking("sphere_sphere_overlap", {0x1p600, 0, 0, 0x1p599, 0x1p601, 0, 0, 0x1p598}));
  EXPECT_EQ(c.kind, CauseKind::overflow) << text_of(c);
}

/// Wrong at any scale at which the square of a length does not vanish: no underflow, although 2^-600 helps.
Answer breaks_always(Values q) {
  if (q[0] * q[0] != 0) return Answer::without(Answer::Status::broke, "exception: not implemented");
  return right("sphere_sphere_overlap", q);
}

TEST(Cause, AnAnswerThatIsRightWhereEverythingVanishesExplainsNothing) {
  const Subject s = planted("sphere_sphere_overlap", breaks_always);
  const Cause c = cause(s, case_asking("sphere_sphere_overlap", {1, 2, 0.5, 1, 3, 0.25, 0, 1}));
  EXPECT_NE(c.kind, CauseKind::underflow) << text_of(c);
  EXPECT_NE(c.kind, CauseKind::absolute_tolerance) << text_of(c);
}

TEST(Border, IsToldFromChance) {
  const Query& query = *find_query("moving_sphere_box");
  Case c = generate(query, Scalar::float64, 1, 0);
  for (std::size_t i = 0; i < c.values.size(); ++i) c.values[i] = 1 + 0.25 * double(i);
  std::vector<Trial> trials;
  for (const Case& near : ulp_neighbours(c, 64, 8, 1)) trials.push_back({near, {}, {}, Outcome::right, 0});
  const auto outcomes_by = [&](auto with_finding) {
    for (std::size_t i = 0; i < trials.size(); ++i)
      trials[i].outcome = with_finding(i, trials[i].question.values) ? Outcome::same : Outcome::right;
    return are_on_two_sides(c, trials);
  };
  EXPECT_TRUE(outcomes_by([&](std::size_t, const auto& x) { return x[0] - c.values[0] > x[4] - c.values[4]; }));
  EXPECT_TRUE(outcomes_by([&](std::size_t, const auto& x) { return x[2] > c.values[2]; }));
  std::uint64_t random = 1;
  EXPECT_FALSE(outcomes_by([&](std::size_t, const auto&) {
    random = random * 6364136223846793005u + 1442695040888963407u;
    return random >> 63 != 0;
  }));
}

TEST(Scales, AreExactOrNothing) {
  const Case c = case_asking("sphere_sphere_overlap", {0, 0, 0, 1, 3, 0, 0, 0x1p-140}, Scalar::float32);
  const ScaleGroup& lengths = scale_groups()[0];
  const auto twice = scaled(c, lengths, 1);
  ASSERT_TRUE(twice.has_value());
  EXPECT_EQ(twice->values, (std::vector<double>{0, 0, 0, 2, 6, 0, 0, 0x1p-139}));
  EXPECT_FALSE(scaled(c, lengths, -20).has_value());
  EXPECT_FALSE(scaled(c, lengths, 128).has_value());
  EXPECT_FALSE(scaled(c, scale_groups()[1], 1).has_value()) << "there is no velocity";
}

TEST(Readings, MakeNoDifferenceToARightAnswerOrMakeItWrong) {
  const Case c = case_asking("moving_sphere_box", {-5, 0.25, 0.5, 1, 2, 0, 0, 0, 0, 0, 1, 2, 3, 0, 0, 0.25, 1});
  const Answer a = right("moving_sphere_box", c.values);
  const IsRight is_right = [](const Case& other, const Answer& answer) {
    return judge(other, answer, Standard{{.backward = 0x1p20}}, Detail::verdict).verdict <= Verdict::not_proved;
  };
  ASSERT_TRUE(is_right(c, a));
  for (const Reading& reading : readings()) {
    const bool harmless = reading.name == "normal not of unit length";
    EXPECT_EQ(reading.right(c, a, is_right).value_or(harmless), harmless) << reading.name;
  }
}

TEST(Regions, HoldWhereTheInputsSaySo) {
  const Case c = case_asking("moving_sphere_box", {-5, 0.25, 0.5, 0, 2, 0, 0, 0, 0, 0, 1, 2, 3, 0, 0, 0.25, 1});
  std::vector<std::string> names;
  for (const Region& r : regions_of(*c.query)) {
    if (r.has(c)) names.push_back(r.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"sphere.radius of zero", "velocity with a component of zero",
                                             "a quaternion that is not of unit length", "a shape without extent",
                                             "a turned box"}));
}

TEST(Explain, WritesAReportWithTheCause) {
  const TemporaryFolder folder;
  const std::string plugin = plugin_file("skim_plugin"), out = (folder / "why").string();
  ASSERT_EQ(nearmiss({"run", "--plugin", plugin, "-s", "skim", "-q", "closest_point_segment", "--cases", "2000",
                      "--seed", "1", "--out", (folder / "r").string()})
                .exit_code,
            1);
  const json index = json::parse(read_file(folder / "r" / "index.json"));
  const std::string found = (folder / "r" / index["reports"][0]["file"].get<std::string>()).string();
  const Ran ran = nearmiss({"explain", "--plugin", plugin, found, "--out", out});
  EXPECT_EQ(ran.exit_code, 1) << ran.err;
  EXPECT_NE(ran.out.find("Inputs\n"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("\nCause: "), std::string::npos) << ran.out;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder / "why" / "closest_point_segment")) files.push_back(entry);
  ASSERT_EQ(files.size(), 1u);
  const json after = json::parse(read_file(files[0]));
  EXPECT_EQ(complaints(after, "report.schema.json"), "");
  EXPECT_FALSE(after["cause"]["evidence"].empty());
  const Ran again = nearmiss({"explain", "--plugin", plugin, files[0].string(), "--out", out, "--json"});
  EXPECT_EQ(json::parse(again.out).at(0)["cause"], after["cause"]);
}

/// The mistakes of docs/example-library/skim.c: constants that squared lengths are compared with.
TEST(Explain, FindsTheConstantsOfTheExampleLibrary) {
  const TemporaryFolder folder;
  const std::string plugin = plugin_file("skim_plugin");
  for (const auto& [query, key] : {std::pair("sphere_sphere_overlap", "1e-4 length^2"),
                                   std::pair("moving_point_sphere", "1e-6 length^2 speed^2")}) {
    ASSERT_EQ(nearmiss({"run", "--plugin", plugin, "-s", "skim", "-q", query, "--cases", "10000", "--seed", "3",
                        "--out", (folder / query).string()})
                  .exit_code,
              1);
    const json index = json::parse(read_file(folder / query / "index.json"));
    const std::string found = (folder / query / index["reports"][0]["file"].get<std::string>()).string();
    const Ran ran = nearmiss({"explain", "--plugin", plugin, found, "--json", "--out", (folder / "why").string()});
    const json cause = json::parse(ran.out).at(0)["cause"];
    EXPECT_EQ(cause["kind"], "absolute tolerance") << cause;
    EXPECT_EQ(cause["key"], key) << cause;
  }
}

TEST(Explain, EndsWithZeroWhereNothingIsFound) {
  const TemporaryFolder folder;
  const Ran ran = nearmiss({"explain", "-s", "collide-fast-double", "--out", (folder / "r").string(),
                            source_folder() + "/corpus/seeds/sphere_sphere_overlap/apart.json"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(ran.out.find("collide-fast-double has no finding against it"), std::string::npos) << ran.out;
  EXPECT_FALSE(fs::exists(folder / "r"));
}

}  // namespace
}  // namespace nearmiss
