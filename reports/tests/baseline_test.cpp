/// What a comparison with a baseline calls new, worse and known, and which findings are one bug.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/tests/mistaken_subject.hpp"
#include "reports/triage/comparison/baseline.hpp"
#include "reports/triage/comparison/rates.hpp"
#include "reports/triage/one_bug.hpp"

namespace nearmiss {
namespace {

constexpr const char* asked_query = "sphere_sphere_overlap";

FindingKind kind_with(const std::string& fault) { return {asked_query, "other", fault, "decision", "what is asked"}; }

FeatureRegions regions_with(std::initializer_list<FeatureRegion> all) {
  FeatureRegions regions;
  for (const FeatureRegion r : all) regions.add(r);
  return regions;
}

TriagedSignature row_of(const FindingPart& part) {
  TriagedSignature s;
  s.kind = part.kind;
  s.parts = {part};
  s.names = names_of_finding(part, s.cause);
  s.id = *s.names.begin();
  s.examined = true;
  s.reports = {"a report"};
  return s;
}

/// So many findings of each part, in cases of its regions.
Sample sample_with(std::uint64_t cases, const std::vector<std::pair<FindingPart, std::uint64_t>>& findings) {
  Sample s;
  s.asked[{asked_query, "other"}] = {cases, cases};
  for (const auto& [part, count] : findings) s.findings[class_of(part.kind, part.regions)] = count;
  return s;
}

/// The change of a row that the baseline has or not.
SignatureChange change_of(const FindingPart& part, const Sample& before, const Sample& now, bool known) {
  Workers workers;
  Baseline baseline{{}, before};
  if (known) baseline.rows = {row_of(part)};
  Triage t;
  t.signatures = {row_of(part)};
  t.sample = now;
  compare_with(baseline, t, {.folder = {}, .tick = [](const std::string&, std::uint64_t, std::uint64_t) {}}, workers);
  return t.signatures.front().change.value();
}

const FindingPart miss{kind_with("false-miss"), {}};
const FindingPart hit_part{kind_with("false-hit"), {}};

TEST(Rates, AreComparedExactly) {
  EXPECT_NEAR(chance_without_rise({0, 4000}, {15, 4000}), 0x1p-15, 1e-12);
  EXPECT_NEAR(chance_without_rise({0, 36000}, {5, 4000}), 1e-5, 1e-9);
  EXPECT_NEAR(chance_without_rise({1, 1000}, {1, 1000}), 0.75, 1e-12);
  EXPECT_EQ(chance_without_rise({0, 0}, {15, 4000}), 1);
  EXPECT_EQ(chance_without_rise({3, 4000}, {0, 4000}), 1);
  EXPECT_LT(chance_without_rise({100, 4000}, {200, 4000}), 1e-8);
  EXPECT_GT(chance_without_rise({100, 4000}, {120, 4000}), 0.05);
}

TEST(Baselines, ARowIsNewOnlyWhereMoreFindingsAreProved) {
  const Sample none = sample_with(4000, {});
  EXPECT_EQ(change_of(miss, none, sample_with(4000, {{miss, 3}}), false), SignatureChange::unproved);
  EXPECT_EQ(change_of(miss, none, sample_with(4000, {{miss, 40}}), false), SignatureChange::fresh);
  EXPECT_EQ(change_of(miss, sample_with(4000, {{miss, 38}}), sample_with(4000, {{miss, 40}}), false),
            SignatureChange::known)
      << "the baseline has such findings, in another row";
  EXPECT_EQ(change_of(miss, sample_with(4000, {{hit_part, 38}}), sample_with(4000, {{miss, 40}}), false),
            SignatureChange::fresh);
  EXPECT_EQ(change_of(miss, {}, sample_with(4000, {{miss, 3}}), false), SignatureChange::fresh)
      << "an older baseline, without counts";
}

TEST(Baselines, TheRegionsOfAMistakeAreCompared) {
  const FindingPart in_place{miss.kind, regions_with({FeatureRegion::same_place})};
  const FindingPart both{miss.kind, regions_with({FeatureRegion::same_place, FeatureRegion::zero_size})};
  const FindingPart zero{miss.kind, regions_with({FeatureRegion::zero_size})};
  const Sample before = sample_with(4000, {{zero, 400}, {both, 40}});
  EXPECT_EQ(change_of(in_place, before, sample_with(4000, {{zero, 410}, {both, 42}, {in_place, 2}}), false),
            SignatureChange::known);
  EXPECT_EQ(change_of(in_place, before, sample_with(4000, {{zero, 390}, {both, 42}, {in_place, 70}}), false),
            SignatureChange::fresh);
}

TEST(Baselines, ARowIsWorseOnlyWhereMoreFindingsAreProved) {
  const Sample before = sample_with(4000, {{miss, 100}});
  EXPECT_EQ(change_of(miss, before, sample_with(4000, {{miss, 120}}), true), SignatureChange::known);
  EXPECT_EQ(change_of(miss, before, sample_with(4000, {{miss, 200}}), true), SignatureChange::worse);
  EXPECT_EQ(change_of(miss, before, sample_with(40000, {{miss, 1100}}), true), SignatureChange::known);
}

// One bug.

const Subject& balls() {
  static const Subject s = subject_with(asked_query, [](Numbers n) { return exact_answer(asked_query, n); });
  return s;
}

/// Findings with their causes, as they are after their examination.
class Findings {
 public:
  void add(const std::string& of, Disagreement fault, CauseKind cause, const std::string& key,
           FeatureRegions regions = {}, const std::vector<Disagreement>& also = {}) {
    filed_.push_back(std::make_unique<FiledReport>());
    filed_.back()->subject = &balls();
    filed_.back()->question = in_double(asked_query, {0, 0, 0, 1, 1, 0, 0, 1});
    auto c = std::make_unique<Candidate>();
    c->filed = filed_.back().get();
    c->finding.verdict = Verdict::exceeds_measure;
    c->finding.disagreement = fault;
    for (const Disagreement d : also) {
      MemberFinding m;
      m.disagreement = d, m.broken = Clause::backward;
      c->finding.members.push_back(m);
    }
    c->kind = {of, "mistaken", std::string(name_of(fault)), "", ""};
    c->examined = ExaminedCase{c->filed->question, "", 0, regions, {}};
    c->examined->cause.kind = cause, c->examined->cause.key = key;
    all_.push_back({c.get(), {c.get()}});
    candidates_.push_back(std::move(c));
  }
  std::size_t bugs() const {
    Workers workers;
    return one_bug_each(all_, workers).size();
  }

 private:
  std::vector<std::unique_ptr<FiledReport>> filed_;
  std::vector<std::unique_ptr<Candidate>> candidates_;
  std::vector<ExaminedFinding> all_;
};

TEST(OneBug, IsOneReadingOrConstantInEveryQuery) {
  Findings f;
  f.add("moving_sphere_box", Disagreement::wrong_normal, CauseKind::convention, "normal reversed");
  f.add("moving_sphere_capsule", Disagreement::wrong_normal, CauseKind::convention, "normal reversed");
  f.add("moving_sphere_box", Disagreement::false_miss, CauseKind::absolute_tolerance, "1e-6");
  f.add("moving_sphere_plane", Disagreement::wrong_time, CauseKind::absolute_tolerance, "1e-6");
  EXPECT_EQ(f.bugs(), 2u);
  f.add("moving_sphere_plane", Disagreement::wrong_time, CauseKind::absolute_tolerance, "1e-8");
  EXPECT_EQ(f.bugs(), 3u) << "another constant";
  f.add("moving_sphere_sphere", Disagreement::wrong_time, CauseKind::rounding, "");
  f.add("moving_sphere_aabox", Disagreement::wrong_time, CauseKind::rounding, "");
  EXPECT_EQ(f.bugs(), 5u) << "rounding in two queries is two places";
}

TEST(OneBug, IsOneMechanismInOneQuery) {
  Findings f;
  f.add("moving_sphere_box", Disagreement::false_miss, CauseKind::iteration_limit, "steps along the motion");
  f.add("moving_sphere_box", Disagreement::wrong_time, CauseKind::iteration_limit, "steps along the motion",
        regions_with({FeatureRegion::turned}));
  EXPECT_EQ(f.bugs(), 1u);
}

TEST(OneBug, HasAnswersThatAreWrongInBothWays) {
  Findings f;
  f.add("sphere_box_penetration", Disagreement::wrong_depth, CauseKind::unexplained, "", {},
        {Disagreement::wrong_normal});
  f.add("sphere_box_penetration", Disagreement::wrong_normal, CauseKind::rounding, "", {}, {Disagreement::wrong_depth});
  EXPECT_EQ(f.bugs(), 1u);
  Findings apart;
  apart.add("sphere_box_penetration", Disagreement::wrong_depth, CauseKind::unexplained, "", {},
            {Disagreement::wrong_normal});
  apart.add("sphere_box_penetration", Disagreement::wrong_normal, CauseKind::rounding, "");
  EXPECT_EQ(apart.bugs(), 2u) << "the normal is wrong where the depth is right";
}

}  // namespace
}  // namespace nearmiss
