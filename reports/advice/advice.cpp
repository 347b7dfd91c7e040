#include "reports/advice/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corpus/storage/codec.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

TradeSettings trade_settings(const AdviceSettings& s) {
  TradeSettings t;
  t.command = s.command;
  t.folder = s.folder;
  t.source = s.source;
  t.queries = s.queries;
  t.subjects = s.subjects;
  t.seed = s.seed;
  t.cases = std::min(s.cases, Advice::timed_cases);
  return t;
}

/// The timed subjects, the cheapest first.
std::vector<RankedSubject> candidates_of(const TradedQuery& traded) {
  std::vector<RankedSubject> all;
  for (const TradeSummary& s : traded.subjects) {
    const RankedSubject c{&s, std::nullopt, s.requirements};
    if (c.cost()) all.push_back(c);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const RankedSubject& a, const RankedSubject& b) { return *a.cost() < *b.cost(); });
  return all;
}

double largest_error(const RankedSubject& c) { return c.measured->shift ? c.measured->shift->max : 0; }

}  // namespace

std::string RankedSubject::failures() const {
  std::vector<std::string> all;
  for (const MetRequirement& r : requirements) {
    if (r.state == MetRequirement::State::failed) all.push_back(failure_text(r));
  }
  return fmt::format("{}", fmt::join(all, "; "));
}

const RankedSubject* AdvisedQuery::down() const { return !chosen || *chosen == 0 ? nullptr : &candidates[*chosen - 1]; }

const RankedSubject* AdvisedQuery::up() const {
  if (!chosen) return nullptr;
  for (std::size_t i = *chosen + 1; i < candidates.size(); ++i) {
    if (candidates[i].measured->meets_all() && largest_error(candidates[i]) < largest_error(candidates[*chosen]))
      return &candidates[i];
  }
  return nullptr;
}

Advice::Advice(AdviceSettings settings)
    : settings_(std::move(settings)),
      trade_(trade_settings(settings_)),
      dispatcher_([this] { return tick(0); }),
      internal_errors_(settings_.folder) {}

bool Advice::tick(std::uint64_t done) {
  done_ += done;
  progress_.show(done_, std::nullopt, std::nullopt, std::nullopt);
  return !interrupted();
}

void Advice::find() {
  trade_.measure();
  for (const Query* q : settings_.queries) {
    if (interrupted()) return;
    AdvisedQuery a{q, settings_.source.share(*q), {}, std::nullopt, {}};
    for (const TradedQuery& traded : trade_.queries()) {
      if (traded.query == q) a = advised(traded);
    }
    if (!interrupted()) advised_.push_back(std::move(a));
  }
}

SceneEvidence Advice::evidence_of(const Subject& subject, const Query& query, const TradeSource& source) {
  progress_.set_activity(fmt::format("evidence for {}, {}", query.name, subject.name));
  return measured_evidence({&subject, &query, &source, evidence_seed(), settings_.cases, true}, dispatcher_,
                           internal_errors_, [this](std::uint64_t done) { return tick(done); });
}

AdvisedQuery Advice::advised(const TradedQuery& traded) {
  AdvisedQuery a{traded.query, traded.share, candidates_of(traded), std::nullopt, {}};
  for (std::size_t i = 0; i < a.candidates.size() && !a.chosen && !interrupted(); ++i) {
    RankedSubject& c = a.candidates[i];
    if (!c.measured->meets_all()) continue;
    c.evidence = evidence_of(c.subject(), *a.query, settings_.source);
    c.requirements = c.evidence->requirements(settings_.source.tolerance, c.cost());
    if (c.meets_all()) a.chosen = i;
  }
  if (!a.candidates.empty() && a.chosen != std::size_t{0}) a.remedies = tried_remedies(a);
  return a;
}

std::vector<TriedRemedy> Advice::tried_remedies(const AdvisedQuery& a) {
  std::vector<TriedRemedy> all;
  for (const Remedy& r : remedies_for(settings_.source, *a.query, evidence_seed())) {
    if (!interrupted()) all.push_back(tried(r, a));
  }
  return all;
}

TriedRemedy Advice::tried(const Remedy& remedy, const AdvisedQuery& a) {
  TriedRemedy best{remedy.name, remedy.words, remedy.source.tolerance.unit, nullptr, {}, {}, std::nullopt, false};
  const std::size_t end = a.chosen.value_or(a.candidates.size());
  for (std::size_t i = 0; i < end && !best.meets_all && !interrupted(); ++i) {
    const RankedSubject& c = a.candidates[i];
    SceneEvidence e = evidence_of(c.subject(), *a.query, remedy.source);
    std::vector<MetRequirement> requirements = e.requirements(remedy.source.tolerance, c.cost());
    const bool meets = e.is_complete() && none_failed(requirements);
    if (best.subject != nullptr && !meets && e.worst_use >= best.evidence.worst_use) continue;
    best.subject = &c.subject();
    best.evidence = std::move(e);
    best.requirements = std::move(requirements);
    best.cost = c.cost();
    best.meets_all = meets;
  }
  return best;
}

std::optional<double> Advice::seconds_per_step() const {
  double nanoseconds = 0;
  for (const AdvisedQuery& a : advised_) {
    if (a.choice() == nullptr) return std::nullopt;
    nanoseconds += a.share * a.choice()->cost().value_or(0);
  }
  return nanoseconds * settings_.source.queries_per_step * 1e-9;
}

void Advice::write() const {
  trade_.write();
  write_file(settings_.folder / "advice.json", pretty_json(to_json()));
  for (const AdvisedQuery& a : advised_) {
    const RankedSubject* choice = a.choice();
    if (choice == nullptr || !choice->evidence->worst) continue;
    make_folder(settings_.folder / "worst");
    write_file(settings_.folder / "worst" / fmt::format("{}.json", a.query->name),
               pretty_json(case_to_json(*choice->evidence->worst)));
  }
}

int Advice::exit_code() const {
  if (trade_.exit_code() == InternalError::exit_code || internal_errors_.count() > 0) return InternalError::exit_code;
  if (interrupted()) return 2;
  const bool all = std::all_of(advised_.begin(), advised_.end(), [](const AdvisedQuery& a) { return a.chosen; });
  return all ? 0 : 1;
}

}  // namespace nearmiss
