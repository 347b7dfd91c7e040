#include "reports/triage/hypotheses/asked_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "corpus/generator/feature_regions.hpp"
#include "corpus/generator/fit.hpp"
#include "corpus/generator/generator.hpp"
#include "reports/triage/geometry/quantities.hpp"
#include "reports/triage/trials/touch_cases.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t sample_size = 256;
constexpr Rounding rounding_modes[] = {Rounding::to_nearest, Rounding::downward, Rounding::upward,
                                       Rounding::toward_zero};

}  // namespace

const std::vector<Trial>& AskedCases::similar() {
  constexpr std::size_t most = 16;
  constexpr std::size_t most_at_touches = 6;
  if (similar_) return *similar_;
  similar_ = is_wrong_decision() ? cases_at_touches(trials_, sample(), most_at_touches) : std::vector<Trial>{};
  std::vector<Trial> around = variants(trials_, most - similar_->size(), seed_);
  similar_->insert(similar_->end(), std::make_move_iterator(around.begin()), std::make_move_iterator(around.end()));
  return *similar_;
}

double AskedCases::rank_of(const Case& c) const {
  if (is_wrong_decision()) return -gap_of(c) / std::ldexp(1.0, largest_exponent_of(c));
  return double(feature_regions_of(c).names().size());
}

const Trial* AskedCases::plainest() {
  const Trial* best = nullptr;
  double least = INFINITY;
  const auto see = [&](const Trial& t) {
    if (t.outcome != Outcome::same || t.question.values == question().values) return;
    const double rank = rank_of(t.question);
    if (rank < least) least = rank, best = &t;
  };
  for (const Trial& t : similar()) see(t);
  if (!is_wrong_decision()) std::for_each(sample().begin(), sample().end(), see);
  return best;
}

std::vector<Trial> AskedCases::generated_with_finding(std::size_t most) {
  constexpr std::size_t batch = 512;
  std::vector<std::pair<double, Trial>> found;
  std::uint64_t index = 0;
  while (found.size() < most && !trials_.is_over()) {
    for (Trial& t : trials_.ask(generated(batch, index))) {
      if (t.outcome != Outcome::same || t.question.values == question().values || found.size() == most) continue;
      const double rank = rank_of(t.question);
      found.emplace_back(rank, std::move(t));
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Trial> ordered;
  for (auto& [rank, trial] : found) ordered.push_back(std::move(trial));
  return ordered;
}

std::vector<Case> AskedCases::generated(std::size_t count, std::uint64_t& index) const {
  const Preconditions required = trials_.subject().offering(trials_.query().name).required;
  std::vector<Case> cases(count);
  for (Case& c : cases) {
    do {
      generate_inside(c, trials_.query(), trials_.subject().scalar, seed_, index++, required);
    } while (has_extreme_mutator(c) || has_feature_mutator(c));  // where shapes just touch, readings are alike
  }
  return cases;
}

const std::vector<Trial>& AskedCases::sample() {
  if (!sample_) sample_ = trials_.ask(generated(sample_size, generated_));
  return *sample_;
}

const std::vector<Trial>& AskedCases::fresh() {
  sample();
  if (!fresh_) fresh_ = trials_.ask(generated(sample_size, generated_));
  return *fresh_;
}

const std::vector<Trial>& AskedCases::neighbours() {
  constexpr std::size_t count = 64;
  constexpr int ulps = 8;
  if (!neighbours_) neighbours_ = trials_.ask(ulp_neighbours(question(), count, ulps, seed_));
  return *neighbours_;
}

const std::vector<Trial>& AskedCases::roundings() {
  if (roundings_) return *roundings_;
  roundings_.emplace();
  if (!trials_.sets_rounding()) return *roundings_;
  for (const Rounding r : rounding_modes) roundings_->push_back(trials_.ask({&question(), 1}, r).front());
  return *roundings_;
}

const std::vector<std::vector<Trial>>& AskedCases::similar_roundings() {
  if (similar_roundings_) return *similar_roundings_;
  similar_roundings_.emplace();
  if (!trials_.sets_rounding() || similar().empty()) return *similar_roundings_;
  std::vector<Case> cases;
  for (const Trial& t : similar()) cases.push_back(t.question);
  similar_roundings_->resize(cases.size());
  for (const Rounding r : rounding_modes) {
    std::vector<Trial> asked = trials_.ask(cases, r);
    for (std::size_t i = 0; i < asked.size(); ++i) (*similar_roundings_)[i].push_back(std::move(asked[i]));
  }
  return *similar_roundings_;
}

const std::vector<ScaleScan>& AskedCases::scans() {
  if (scans_) return *scans_;
  scans_.emplace();
  for (const ScaleGroup& group : scale_groups()) scans_->push_back(scan(trials_, group));
  return *scans_;
}

std::optional<std::pair<double, double>> AskedCases::errors_of(std::span<const Trial> trials) const {
  constexpr std::size_t enough = 8;
  double low = INFINITY, high = 0;
  std::size_t seen = 0;
  for (const Trial& t : trials) {
    if (t.outcome != Outcome::same || seen == enough) continue;
    const Finding full = trials_.in_full(t);
    const MemberFinding* member = full.headline_member();
    if (member == nullptr || member->worst < 0 || !(member->forward_absolute > 0)) return std::nullopt;
    low = std::min(low, member->forward_absolute), high = std::max(high, member->forward_absolute), ++seen;
  }
  return seen == 0 ? std::nullopt : std::optional(std::pair(low, high));
}

bool AskedCases::same_in_all_roundings() {
  return !roundings().empty() && count(roundings(), Outcome::same) == roundings().size();
}

std::string_view AskedCases::and_in_every_rounding() {
  return roundings().empty() ? "" : " and in every rounding mode";
}

bool AskedCases::is_exact() {
  return std::any_of(roundings().begin(), roundings().end(), [](const Trial& t) {
    return t.outcome == Outcome::same && t.answer.status == Answer::Status::answered && t.raised == 0;
  });
}

bool AskedCases::errs_to_both_sides() {
  constexpr std::ptrdiff_t least = 4;
  const auto with = [&](Disagreement d) {
    return std::count_if(sample().begin(), sample().end(), [d](const Trial& t) { return t.finding.disagreement == d; });
  };
  return std::min(with(Disagreement::false_hit), with(Disagreement::false_miss)) >= least;
}

bool AskedCases::is_wrong_decision() const {
  const Disagreement d = trials_.base().finding.disagreement;
  return d == Disagreement::false_hit || d == Disagreement::false_miss;
}

int largest_exponent_of(const Case& c) {
  double largest = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const Role role = c.role(i);
    if (role == Role::position || role == Role::size) largest = std::max(largest, std::abs(c.values[i]));
  }
  return largest > 0 ? std::ilogb(largest) : 0;
}

std::string of_text(std::size_t part, std::size_t all) { return fmt::format("{} of {}", part, all); }

}  // namespace nearmiss
