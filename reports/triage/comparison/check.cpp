#include "reports/triage/comparison/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "corpus/files/errors.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/run.hpp"
#include "reports/findings/text.hpp"
#include "reports/triage/comparison/rates.hpp"
#include "reports/triage/triage_text.hpp"

namespace nearmiss {

namespace {

using CheckClock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// The shares of the time after which the cases of the baseline's run, and the fresh cases, end.
constexpr double end_of_again = 0.4, end_of_fresh = 0.7;

/// One check.
class Checking {
 public:
  Checking(const Baseline& baseline, const CheckSettings& settings, Workers& workers)
      : baseline_(baseline), settings_(settings), workers_(workers), begin_(CheckClock::now()) {}

  Check result() {
    std::vector<BaselineNow::Of> all;
    for (const auto& [of, cases] : baseline_.sample.asked) all.push_back(of);
    const BaselineNow asked = ask_baseline(baseline_, all, triage_settings(end_of_again), workers_);
    for (const std::optional<CasesNow>& row : asked.rows) add(row);
    check_.again = asked.again, check_.all_again = asked.all_again;
    check_.seed = settings_.seed;
    check_.without_fresh = why_not_fresh();
    if (check_.without_fresh.empty()) ask_fresh_cases();
    if (!interrupted()) check_.not_asked = compare_with(baseline_, asked, check_.triage, triage_settings(1), workers_);
    return std::move(check_);
  }

 private:
  void add(const std::optional<CasesNow>& row) {
    if (!row) return;
    check_.kept.asked += row->asked, check_.kept.wrong += row->wrong, check_.kept.gone += row->gone;
  }
  Seconds left_until(double share) const {
    return std::max(Seconds(0), settings_.time * share - Seconds(CheckClock::now() - begin_));
  }
  TriageSettings triage_settings(double share) const {
    return {settings_.folder / "triage", left_until(share), settings_.tick,
            [this](const FindingKind& kind, FeatureRegions regions) { return may_be_new(kind, regions); }};
  }

  /// Rates are comparable where the baseline's cases are of the same generator.
  std::string why_not_fresh() const {
    if (baseline_.sample.empty()) return "the baseline does not say how many cases were asked";
    if (!baseline_.sample.seed) return "the cases of the baseline are not those of the generator alone";
    if (!can_be_drawn_again(baseline_.sample))
      return fmt::format("the baseline is of Nearmiss {}, whose cases differ", baseline_.sample.version);
    return "";
  }
  void ask_fresh_cases() {
    const auto until = CheckClock::now() + std::chrono::duration_cast<CheckClock::duration>(left_until(end_of_fresh));
    Run run({.command = settings_.command,
             .folder = settings_.folder,
             .queries = queries(),
             .subjects = subjects(),
             .seed = settings_.seed,
             .until = until});
    run.set_activity("fresh cases");
    run.generate(std::nullopt);
    run.finish();
    if (interrupted()) return;
    Sources sources = read_sources({settings_.folder.string()});
    leave_out_what_was_not_asked(sources);
    fresh_ = &sources.sample;
    check_.triage = triage(sources, triage_settings(1), workers_);
    fresh_ = &check_.triage.sample;
  }
  std::vector<const Query*> queries() const {
    std::vector<const Query*> all;
    for (const auto& [of, asked] : baseline_.sample.asked) {
      const Query* q = find_query(of.first);
      if (q != nullptr && std::find(all.begin(), all.end(), q) == all.end()) all.push_back(q);
    }
    return all;
  }
  std::vector<const Subject*> subjects() const {
    std::vector<const Subject*> all;
    for (const auto& [of, asked] : baseline_.sample.asked) {
      const Subject* s = find_subject(of.second);
      if (s != nullptr && std::find(all.begin(), all.end(), s) == all.end()) all.push_back(s);
    }
    return all;
  }
  /// The baseline may have asked a query of one subject and not of another.
  void leave_out_what_was_not_asked(Sources& fresh) const {
    const auto is_asked = [&](const std::string& query, const std::string& subject) {
      return baseline_.has_asked(query, subject);
    };
    std::erase_if(fresh.reports, [&](const FiledReport& r) {
      return !is_asked(std::string(r.question.query->name), r.subject->name);
    });
    std::erase_if(fresh.counts, [&](const CountedVariant& v) { return !is_asked(v.kind.query, v.kind.subject); });
    std::erase_if(fresh.sample.asked, [&](const auto& a) { return !is_asked(a.first.first, a.first.second); });
    std::erase_if(fresh.sample.findings, [&](const auto& f) { return !is_asked(f.first.query, f.first.subject); });
  }

  /// The baseline has no such findings, or their rate may have risen in cases of one of these regions.
  bool may_be_new(const FindingKind& kind, FeatureRegions regions) const {
    if (baseline_.sample.rate_of(kind, {}).findings == 0) return true;
    std::vector<FeatureRegions> tested{{}, regions};
    for (int r = 0; r < feature_region_count; ++r) {
      if (!regions.has(FeatureRegion(r))) continue;
      tested.emplace_back();
      tested.back().add(FeatureRegion(r));
    }
    return std::any_of(tested.begin(), tested.end(), [&](FeatureRegions of) {
      return chance_without_rise(baseline_.sample.rate_of(kind, of), fresh_->rate_of(kind, of)) < error_of_a_comparison;
    });
  }

  const Baseline& baseline_;
  const CheckSettings& settings_;
  Workers& workers_;
  CheckClock::time_point begin_;
  Check check_;
  const Sample* fresh_ = &check_.triage.sample;
};

std::uint64_t cases_in(const Sample& s) {
  std::uint64_t all = 0;
  for (const auto& [of, asked] : s.asked) all += asked.cases;
  return all;
}

std::uint64_t findings_in(const Sample& s) {
  std::uint64_t all = 0;
  for (const auto& [of, count] : s.findings) all += count;
  return all;
}

/// The texts of the rows that are shown, at most so many, and how many more there are.
std::string rows_text(const Triage& t, std::size_t most, const std::function<bool(const TriagedSignature&)>& is_shown,
                      const std::function<std::string(const TriagedSignature&)>& text_of) {
  std::string text;
  std::size_t seen = 0;
  for (const TriagedSignature& s : t.signatures) {
    if (is_shown(s) && ++seen <= most) text += text_of(s);
  }
  if (seen > most) text += fmt::format("and {} more: triage.json\n", seen - most);
  return text;
}

bool is_better(const TriagedSignature& s) {
  return s.change == SignatureChange::fixed || s.change == SignatureChange::part_fixed;
}

/// "fixed: fcl moving_sphere_box: false-miss (4512c1732518)".
std::string better_text(const TriagedSignature& s) {
  const std::string why = s.change == SignatureChange::part_fixed ? fmt::format(", {}", s.why) : "";
  return wrapped_text(
      fmt::format("{}: {} {}: {} ({}){}", name_of(*s.change), s.kind.subject, s.kind.query, s.kind.fault, s.id, why),
      "  ");
}

}  // namespace

Check check_against(const Baseline& baseline, const CheckSettings& settings, Workers& workers) {
  std::set<std::string> subjects;
  for (const TriagedSignature& s : baseline.rows) subjects.insert(s.kind.subject);
  for (const auto& [of, asked] : baseline.sample.asked) subjects.insert(of.second);
  const bool none = std::none_of(subjects.begin(), subjects.end(),
                                 [](const std::string& name) { return find_subject(name) != nullptr; });
  if (none && !subjects.empty())
    throw BadInput(fmt::format("none of the baseline's subjects can be asked here: {}; --plugin and --command add them",
                               list_text(std::vector<std::string>(subjects.begin(), subjects.end()))));
  if (subjects.empty()) throw BadInput("the baseline has no findings and no cases");
  return Checking(baseline, settings, workers).result();
}

std::string check_text(const Check& check) {
  constexpr std::size_t most_standing = 4, most_better = 8;
  std::string text = fmt::format("kept cases: {} asked, {} still wrong, {} gone\n", count_text(check.kept.asked),
                                 count_text(check.kept.wrong), count_text(check.kept.gone));
  text += fmt::format("the baseline's run: {} asked again{}\n", plural_text(cases_in(check.again), "case"),
                      check.all_again ? "" : ", not all: --minutes gives more time");
  if (check.without_fresh.empty()) {
    text += fmt::format("fresh cases: {} with seed {}, {}\n", count_text(cases_in(check.triage.sample)), check.seed,
                        plural_text(findings_in(check.triage.sample), "finding"));
  } else {
    text += fmt::format("fresh cases: none, because {}\n", check.without_fresh);
  }
  text += triage_counts_text(check.triage);
  const auto stands = [](const TriagedSignature& s) { return s.stands(); };
  text += rows_text(check.triage, most_standing, stands,
                    [](const TriagedSignature& s) { return "\n" + signature_text(s); });
  const std::string better = rows_text(check.triage, most_better, is_better, better_text);
  return better.empty() ? text : text + "\n" + better;
}

}  // namespace nearmiss
