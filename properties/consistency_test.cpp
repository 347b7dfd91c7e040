/// The oracles of moving and of fixed shapes agree. Inputs lie on a coarse grid and times have few bits, so that the
/// moved sphere's center is exactly a double, and the test can ask the oracles directly.
#include <fmt/format.h>
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "corpus/generator/generator.hpp"
#include "corpus/storage/codec.hpp"
#include "oracles/exact/oracle.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

using Values = std::vector<double>;

constexpr std::uint64_t cases_per_query = 1500;

bool is_yes(const char* query, const Values& values) {
  const Case c{find_query(query), Scalar::float64, values, "", 0, 0, {}};
  if (c.fields().size() != values.size()) throw std::logic_error(std::string(query) + ": another number of inputs");
  return truth_is_yes(c);
}

/// Encloses the exact value of a number over the answers that are a yes.
Bounds exact_value(const char* query, const Values& values, std::size_t number) {
  Answer about;
  about.yes = true;
  return oracle_of(*find_query(query)).exact(values, about, Scalar::float64, nullptr).error[number];
}

std::string written(const Query& query, const Values& values) {
  return case_to_json({&query, Scalar::float64, values, "", 0, 0, {}}).dump();
}

/// The generator's case on a grid of 1/16, within 64; rotations are small integers. Empty if that breaks a rule.
std::optional<Values> on_grid(const Query& query, std::uint64_t seed, std::uint64_t index) {
  Values values = generate(query, Scalar::float32, seed, index).values;
  bool turned = false;
  std::size_t last_of_rotation = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Role role = query.inputs[i].role;
    if (role == Role::flag || role == Role::index) continue;
    const double cell = role == Role::rotation ? 0.5 : 0.0625;
    values[i] = std::clamp(std::nearbyint(values[i] / cell) * cell, -64.0, 64.0);
    if (role != Role::rotation) continue;
    turned = query.inputs[i].name.ends_with(".x") ? values[i] != 0 : turned || values[i] != 0;
    last_of_rotation = i;
    if (query.inputs[i].name.ends_with(".w") && !turned) values[last_of_rotation] = 1;
  }
  if (query.broken(values)) return std::nullopt;
  return values;
}

/// A number of at most 24 bits below (above) x > 0.
double coarse(double x, int direction) {
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(x, &exponent), 24);
  return std::ldexp(direction < 0 ? std::ceil(mantissa) - 1 : std::floor(mantissa) + 1, exponent - 24);
}

/// A sphere that moves past a fixed shape: center, radius, velocity, and the numbers of the shape.
struct Motion {
  const char* query;
  bool (*overlaps)(const Values& sphere_and_thing);
  /// The shape seen from its back, if it has one.
  std::optional<Values> (*turned_over)(const Values& thing);
};
std::ostream& operator<<(std::ostream& out, const Motion& m) { return out << m.query; }

Values part(const Values& values, std::size_t begin, std::size_t end) {
  return {values.begin() + std::ptrdiff_t(begin), values.begin() + std::ptrdiff_t(end)};
}
Values joined(Values a, const Values& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}
/// Picks vectors of three numbers, in that order.
Values picked(const Values& values, std::initializer_list<std::size_t> vectors) {
  Values all;
  for (const std::size_t v : vectors) all = joined(all, part(values, 3 * v, 3 * v + 3));
  return all;
}
std::optional<Values> no_back(const Values&) { return std::nullopt; }

const Motion motions[] = {
    {"moving_sphere_sphere", [](const Values& x) { return is_yes("sphere_sphere_overlap", x); }, no_back},
    {"moving_sphere_box", [](const Values& x) { return is_yes("sphere_box_overlap", x); }, no_back},
    {"moving_sphere_capsule", [](const Values& x) { return is_yes("sphere_capsule_overlap", x); }, no_back},
    {"moving_sphere_plane",
     [](const Values& x) {
       Values behind = x;
       for (std::size_t i = 4; i < 8; ++i) behind[i] = -x[i];
       return is_yes("sphere_plane_penetration", x) && is_yes("sphere_plane_penetration", behind);
     },
     [](const Values& plane) -> std::optional<Values> {
       return Values{-plane[0], -plane[1], -plane[2], -plane[3]};
     }},
    {"moving_sphere_triangle", [](const Values& x) { return is_yes("sphere_triangle_overlap", x); },
     [](const Values& triangle) -> std::optional<Values> {
       return picked(triangle, {0, 2, 1});
     }},
    {"moving_sphere_rectangle",
     [](const Values& x) {
       const Values sphere = part(x, 0, 4), corners = part(x, 4, x.size());
       return is_yes("sphere_triangle_overlap", joined(sphere, picked(corners, {0, 1, 2}))) ||
              is_yes("sphere_triangle_overlap", joined(sphere, picked(corners, {0, 2, 3})));
     },
     [](const Values& corners) -> std::optional<Values> {
       return picked(corners, {0, 3, 2, 1});
     }},
};

/// One motion, tested at several times.
class Asked {
 public:
  Asked(const Motion& motion, const Values& values)
      : motion_(motion),
        sphere_(part(values, 0, 4)),
        velocity_(part(values, 4, 7)),
        thing_(part(values, 7, values.size())) {
    take_first_contact(values);
    if (const auto back = motion.turned_over(thing_)) take_first_contact(joined(part(values, 0, 7), *back));
  }

  bool hits() const { return hits_; }
  const Bounds& time() const { return time_; }
  double radius() const { return sphere_[3]; }
  double speed() const { return std::abs(velocity_[0]) + std::abs(velocity_[1]) + std::abs(velocity_[2]); }

  /// The case at rest at time t, with a radius larger by `more`; empty if the place or the radius is no double.
  std::optional<bool> overlaps_at(double t, double more = 0) const {
    Values sphere = sphere_;
    for (int i = 0; i < 3; ++i) {
      const mpq_class at = mpq_class(sphere_[i]) + mpq_class(velocity_[i]) * mpq_class(t);
      sphere[i] = at.get_d();
      if (mpq_class(sphere[i]) != at) return std::nullopt;
    }
    sphere[3] += more;
    if (sphere[3] - more != sphere_[3]) return std::nullopt;
    return motion_.overlaps(joined(sphere, thing_));
  }

 private:
  /// The earlier contact of both sides of the shape.
  void take_first_contact(const Values& values) {
    if (!is_yes(motion_.query, values)) return;
    const Bounds t = exact_value(motion_.query, values, 0);
    time_ = hits_ ? Bounds{std::min(time_.low, t.low), std::min(time_.high, t.high)} : t;
    hits_ = true;
  }

  const Motion& motion_;
  Values sphere_, velocity_, thing_;
  bool hits_ = false;
  Bounds time_;
};

/// How motion and rest contradict each other; "" if they agree.
std::string contradiction(const Asked& a, int& moving_hits) {
  const bool at_start = a.overlaps_at(0).value();
  if (a.hits() && a.time().high == 0) return at_start ? "" : "a contact at time 0 without an overlap at the start";
  if (a.hits() && at_start) return "an overlap at the start and a first contact later";
  if (!a.hits()) {
    if (at_start && a.radius() == 0) return "";  // a point that starts inside never enters
    for (const double t : {0.0625, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 4.0}) {
      if (a.overlaps_at(t).value_or(false)) return fmt::format("a miss, and an overlap at time {}", t);
    }
    return "";
  }
  const double before = coarse(a.time().low, -1), after = coarse(a.time().high, 1);
  for (const double t : {0.25 * before, 0.5 * before, 0.875 * before, before}) {
    if (a.overlaps_at(coarse(t, -1)).value_or(false))
      return fmt::format("an overlap at {}, before the first contact", t);
  }
  if (a.time().low == a.time().high && !a.overlaps_at(a.time().low).value_or(true)) return "no overlap at the contact";
  // Between the two times the distance changes by at most the distance travelled; a graze has ended by then.
  const double way = coarse(2 * a.speed() * (after - before), 1);
  for (const double t : {before, after}) {
    if (!a.overlaps_at(t, way).value_or(true)) return fmt::format("not within {} of the contact at {}", way, t);
  }
  moving_hits += a.overlaps_at(before, way).has_value();
  return "";
}

class MotionsAndRest : public testing::TestWithParam<Motion> {};

TEST_P(MotionsAndRest, FitTogether) {
  const Motion& motion = GetParam();
  const Query& query = *find_query(motion.query);
  int moving_hits = 0;
  for (std::uint64_t i = 0; i < cases_per_query; ++i) {
    const auto values = on_grid(query, 41, i);
    if (!values) continue;
    ASSERT_EQ(contradiction(Asked(motion, *values), moving_hits), "") << written(query, *values);
  }
  EXPECT_GT(moving_hits, int(cases_per_query) / 20);
}

INSTANTIATE_TEST_SUITE_P(Every, MotionsAndRest, testing::ValuesIn(motions), testing::PrintToStringParamName());

/// The inputs of `passes` are those of the motion, then the limit and the flag `forever`.
void passes_fits(const char* passes, const char* motion, const char* overlap) {
  const Query& query = *find_query(passes);
  int decided_by_limit = 0;
  for (std::uint64_t i = 0; i < cases_per_query; ++i) {
    const auto values = on_grid(query, 42, i);
    if (!values) continue;
    const Values moving = part(*values, 0, values->size() - 2);
    const bool at_start = is_yes(overlap, joined(part(moving, 0, 4), part(moving, 7, moving.size())));
    const bool hits = is_yes(motion, moving);
    const auto passing = [&](double limit, bool forever) {
      return is_yes(passes, joined(moving, {limit, double(forever)}));
    };
    ASSERT_EQ(passing(0, false), at_start) << written(query, *values);
    ASSERT_EQ(passing(0, true), at_start || hits) << written(query, *values);
    if (at_start || !hits) continue;
    const Bounds time = exact_value(motion, moving, 0);
    ASSERT_TRUE(passing(time.high, false)) << written(query, *values);
    ASSERT_FALSE(passing(std::nextafter(time.low, 0.0), false)) << written(query, *values);
    const double limit = values->at(values->size() - 2);
    if (limit >= time.low && limit < time.high) continue;
    ASSERT_EQ(passing(limit, false), limit >= time.high) << written(query, *values);
    ++decided_by_limit;
  }
  EXPECT_GT(decided_by_limit, int(cases_per_query) / 20);
}

TEST(Passing, ABoxFitsTheTimeOfImpact) {
  passes_fits("moving_sphere_passes_box", "moving_sphere_box", "sphere_box_overlap");
}
TEST(Passing, ASphereFitsTheTimeOfImpact) {
  passes_fits("moving_sphere_passes_sphere", "moving_sphere_sphere", "sphere_sphere_overlap");
}

/// Two queries with the same decision.
void same_decisions(const char* one, const char* other) {
  const Query& query = *find_query(one);
  int yes = 0;
  for (std::uint64_t i = 0; i < 2 * cases_per_query; ++i) {
    const auto values = on_grid(query, 43, i);
    if (!values) continue;
    const bool decision = is_yes(one, *values);
    ASSERT_EQ(is_yes(other, *values), decision) << written(query, *values);
    yes += decision;
  }
  EXPECT_GT(yes, int(cases_per_query) / 10);
}

TEST(Overlap, OfBoxesIsTheSignOfTheirPenetration) { same_decisions("box_box_overlap", "box_box_penetration"); }
TEST(Overlap, OfSphereAndBoxIsTheSignOfTheirPenetration) {
  same_decisions("sphere_box_overlap", "sphere_box_penetration");
}
TEST(Overlap, OfSpheresIsTheSignOfTheirPenetration) {
  same_decisions("sphere_sphere_overlap", "sphere_sphere_penetration");
}

TEST(Overlap, OfBoxesIsSeenAlongEveryAxis) {
  const Query& query = *find_query("box_box_overlap");
  int apart = 0;
  for (std::uint64_t i = 0; i < cases_per_query; ++i) {
    const auto values = on_grid(query, 44, i);
    if (!values) continue;
    const Values boxes = part(*values, 0, values->size() - 1);
    const bool overlap = is_yes("box_box_overlap", *values);
    bool separated = false;
    for (double axis = 0; axis < 15; ++axis) {
      separated = separated || exact_value("box_box_projected_distance", joined(boxes, {axis}), 0).low > 0;
    }
    ASSERT_EQ(overlap, !separated) << written(query, *values);
    ASSERT_TRUE(!overlap || is_yes("box_box_conservative", boxes)) << written(query, *values);
    apart += separated;
  }
  EXPECT_GT(apart, int(cases_per_query) / 10);
}

/// A ball of radius 0 is a point: same decisions, same times.
TEST(MovingPoint, PastABoxIsAMovingSphereOfRadiusZero) {
  const Query& query = *find_query("moving_point_box");
  int hits = 0;
  for (std::uint64_t i = 0; i < cases_per_query; ++i) {
    const auto values = on_grid(query, 45, i);
    if (!values) continue;
    const Values sphere = joined(joined(part(*values, 0, 3), {0}), part(*values, 3, values->size()));
    const bool hit = is_yes("moving_point_box", *values);
    ASSERT_EQ(is_yes("moving_sphere_box", sphere), hit) << written(query, *values);
    if (!hit) continue;
    const Bounds point = exact_value("moving_point_box", *values, 0),
                 ball = exact_value("moving_sphere_box", sphere, 0);
    ASSERT_TRUE(point.low <= ball.high && ball.low <= point.high) << written(query, *values);
    ++hits;
  }
  EXPECT_GT(hits, int(cases_per_query) / 20);
}

}  // namespace
}  // namespace nearmiss
