#include "reports/triage/triage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "oracles/scene_limits.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/night_changes.hpp"
#include "reports/findings/hash.hpp"
#include "reports/findings/text.hpp"
#include "reports/triage/candidates.hpp"
#include "reports/triage/one_bug.hpp"

namespace nearmiss {

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// The most time for the examination of one report, and for the ranges of the numbers of a row's simplest case.
constexpr Seconds most_for_one{16}, most_for_ranges{4};

std::string hash_of(std::initializer_list<std::string_view> words) {
  Fnv1a fnv;
  for (const std::string_view word : words) fnv.add(word);
  return fnv.id();
}

/// The name of a part without its cause.
std::string name_of_class(const FindingPart& part) {
  const FindingClass of = class_of(part.kind, part.regions);
  return hash_of(
      {"class", of.query, of.subject, of.fault, of.breakage, fmt::format("{}", fmt::join(part.regions.names(), ","))});
}

/// The name of a cause that may have several parts; empty for one that is told by the regions.
std::string name_of_cause(const FindingKind& kind, const Cause& cause) {
  if (is_shared_by_queries(cause)) return hash_of({"cause", kind.subject, name_of(cause.kind), cause.key});
  if (told_by_regions(cause) > 0) return "";
  return hash_of({"cause", kind.subject, kind.query, name_of(cause.kind), cause.key});
}

FeatureRegions common(FeatureRegions a, FeatureRegions b) {
  FeatureRegions both;
  for (int r = 0; r < feature_region_count; ++r) {
    if (a.has(FeatureRegion(r)) && b.has(FeatureRegion(r))) both.add(FeatureRegion(r));
  }
  return both;
}

Cause unknown_cause() {
  Cause cause;
  cause.text = "It was not looked for: the time was over.";
  return cause;
}

/// The findings that are one bug, as a row.
class RowOfBug {
 public:
  explicit RowOfBug(std::vector<const ExaminedFinding*> parts) : parts_(std::move(parts)) {}

  TriagedSignature row() const {
    TriagedSignature s;
    const ExaminedFinding& main = main_part();
    s.kind = main.kind();
    s.version = main.examined->filed->subject->version;
    s.asked_as = main.examined->filed->subject->offering(s.kind.query).how;
    s.examined = main.has_cause();
    s.cause = cause_part().has_cause() ? cause_part().cause() : unknown_cause();
    name_parts(s);
    const std::string of_cause = cause_part().has_cause() ? name_of_cause(s.kind, s.cause) : "";
    s.id = of_cause.empty() ? name_of_class({main.kind(), main.regions()}) : of_cause;
    const ExaminedFinding& simplest = simplest_part();
    s.case_of_simplest = simplest.simplest();
    s.simplest = (simplest.has_cause() ? simplest.examined->examined->file : simplest.examined->filed->file).string();
    s.branches = simplest.has_cause() ? simplest.examined->examined->branches : simplest.examined->variant.branches;
    return s;
  }

 private:
  void name_parts(TriagedSignature& s) const {
    s.regions = main_part().regions();
    for (const ExaminedFinding* p : parts_) {
      const FindingPart part{p->kind(), p->regions()};
      s.names.merge(names_of_finding(part, p->has_cause() ? p->cause() : unknown_cause()));
      s.parts.push_back(part);
      s.regions = common(s.regions, p->regions());
    }
    std::sort(s.parts.begin(), s.parts.end());
    s.parts.erase(std::unique(s.parts.begin(), s.parts.end()), s.parts.end());
  }
  /// The part with the most reports.
  const ExaminedFinding& main_part() const {
    return **std::max_element(parts_.begin(), parts_.end(), [](const ExaminedFinding* a, const ExaminedFinding* b) {
      return std::tuple(a->cases.size(), name_of_class({b->kind(), b->regions()})) <
             std::tuple(b->cases.size(), name_of_class({a->kind(), a->regions()}));
    });
  }
  /// The part whose cause says most: a mechanism before regions.
  const ExaminedFinding& cause_part() const {
    const auto rank_of = [](const ExaminedFinding* f) {
      const int told = f->has_cause() ? told_by_regions(f->cause()) : 0;
      const bool has_key = f->has_cause() && !f->cause().key.empty();
      return std::tuple(f->has_cause(), told == 0, told == 0 ? int(has_key) : told, f->cases.size());
    };
    return **std::max_element(parts_.begin(), parts_.end(), [&](const ExaminedFinding* a, const ExaminedFinding* b) {
      return rank_of(a) < rank_of(b);
    });
  }
  /// Of the parts with the row's cause, the one with the plainest case.
  const ExaminedFinding& simplest_part() const {
    const ExaminedFinding& cause = cause_part();
    const auto rank_of = [&](const ExaminedFinding* f) {
      const bool has_cause =
          f->has_cause() == cause.has_cause() && (!f->has_cause() || f->cause().kind == cause.cause().kind);
      return std::tuple(!has_cause, plainness_of(f->simplest()));
    };
    return **std::min_element(parts_.begin(), parts_.end(), [&](const ExaminedFinding* a, const ExaminedFinding* b) {
      return rank_of(a) < rank_of(b);
    });
  }

  std::vector<const ExaminedFinding*> parts_;
};

/// "from 1e+19 up and 1e-20 down".
std::string borders_text(const ExtremeMagnitudes& m) {
  const std::string up = m.up_from > 0 ? fmt::format("from {:.0e} up", m.up_from) : "";
  const std::string down = m.down_from > 0 ? fmt::format("from {:.0e} down", m.down_from) : "";
  return up.empty() ? down : down.empty() ? up : fmt::format("{} and {}", up, down);
}

/// One triage.
class Work {
 public:
  Work(const Sources& sources, const TriageSettings& settings, Workers& workers)
      : sources_(sources),
        settings_(settings),
        workers_(workers),
        examined_(settings.folder, workers),
        begin_(Clock::now()) {}

  Triage result() {
    triage_.sources = sources_.names;
    triage_.skipped = sources_.skipped;
    triage_.sample = sources_.sample;
    triage_.measure = measure_of_sources();
    triage_.measure.declared.reset();  // that of one report
    ask_again();
    std::stable_partition(groups_.begin(), groups_.end(), [](const auto& g) { return is_ours(g.kind.subject); });
    for (CandidatesOfKind& g : groups_) choose(g);
    examine_groups();
    for (const CandidatesOfKind& g : groups_) take_parts(g);
    make_rows();
    add_ranges();
    for (const CandidatesOfKind& g : groups_) {
      for (const Candidate& c : g.all) add(c);
    }
    count();
    for (TriagedSignature& s : triage_.signatures) describe_range(s);
    propose_conventions();
    rank(triage_.signatures);
    return std::move(triage_);
  }

 private:
  using Of = std::pair<std::string, std::string>;  ///< query and subject

  /// That of a report whose subject promises nothing; the usual measure where there is none.
  SceneMeasure measure_of_sources() const {
    for (const FiledReport& r : sources_.reports) {
      if (!r.subject->standard_for(r.question.query->name).promised) return r.measure;
    }
    return sources_.reports.empty() ? SceneMeasure() : sources_.reports.front().measure;
  }
  Seconds time_left() const { return settings_.time - Seconds(Clock::now() - begin_); }

  void ask_again() {
    std::map<FindingKind, std::size_t> at;
    for (std::size_t i = 0; i < sources_.reports.size() && !interrupted(); ++i) {
      settings_.tick("asking again", i, sources_.reports.size());
      const FiledReport& r = sources_.reports[i];
      std::optional<Candidate> c = asked_again(r, workers_);
      if (interrupted()) return;  // the answer may be that the worker gave up
      if (!c) {
        triage_.right_now.push_back(r);
        continue;
      }
      const auto [found, is_new] = at.try_emplace(c->kind, groups_.size());
      if (is_new) groups_.push_back({c->kind, {}, 0});
      groups_[found->second].all.push_back(std::move(*c));
    }
  }

  /// The first of every group, then the second of every group, and so on.
  void examine_groups() {
    std::size_t total = 0, done = 0;
    for (const CandidatesOfKind& g : groups_) total += g.to_examine;
    for (std::size_t turn = 0; turn < most_examined; ++turn) {
      auto left = std::size_t(std::count_if(groups_.begin(), groups_.end(),
                                            [&](const CandidatesOfKind& g) { return turn < g.to_examine; }));
      for (CandidatesOfKind& g : groups_) {
        if (turn >= g.to_examine) continue;
        if (interrupted() || time_left() <= Seconds(0)) {
          triage_.all_examined = false;
          return;
        }
        // Each of the kinds that are left may take its share: so the time suffices for all.
        examine(g.all[turn], std::min(most_for_one, time_left() / double(left--)), done++, total);
      }
    }
  }
  void examine(Candidate& c, Seconds time, std::size_t done, std::size_t total) {
    const std::string activity = fmt::format("examining {} of {}", c.kind.query, c.kind.subject);
    const auto tick = [&](std::uint64_t) { settings_.tick(activity, done, total); };
    tick(0);
    use_measure(c.filed->measure);
    c.examined = examined_.earlier(*c.filed);
    const bool is_wanted = !settings_.is_examined || settings_.is_examined(c.kind, c.variant.regions);
    if (!c.examined && is_wanted) c.examined = examined_.examine(*c.filed, c.plain, time, tick);
  }

  /// The examined findings of a kind, each with the reports that are most like it. Where none was examined, the first
  /// report stands for all.
  void take_parts(const CandidatesOfKind& g) {
    const std::size_t first = parts_.size();
    for (const Candidate& c : g.all) {
      if (c.examined) parts_.push_back({&c, {}});
    }
    if (parts_.size() == first && g.to_examine > 0) parts_.push_back({&g.all.front(), {}});
    if (parts_.size() == first) return;
    const auto tolerance = std::find_if(parts_.begin() + std::ptrdiff_t(first), parts_.end(), [](const auto& p) {
      return p.has_cause() && p.cause().kind == CauseKind::absolute_tolerance;
    });
    for (const Candidate& c : g.all) {
      if (c.extreme && tolerance == parts_.end()) continue;  // the row of the range takes it
      const auto part = c.extreme ? tolerance : most_alike(first, c);
      part->cases.push_back(&c);
    }
  }
  std::vector<ExaminedFinding>::iterator most_alike(std::size_t first, const Candidate& c) {
    return std::max_element(parts_.begin() + std::ptrdiff_t(first), parts_.end(), [&](const auto& a, const auto& b) {
      const auto rank_of = [&](const ExaminedFinding& p) {
        return std::tuple(p.examined == &c, likeness(*p.examined, c.variant));
      };
      return rank_of(a) < rank_of(b);
    });
  }

  void make_rows() {
    for (const std::vector<std::size_t>& group : one_bug_each(parts_, workers_)) {
      std::vector<const ExaminedFinding*> parts;
      for (const std::size_t i : group) {
        parts.push_back(&parts_[i]);
        for (const Candidate* c : parts_[i].cases) row_of_[c] = triage_.signatures.size();
      }
      triage_.signatures.push_back(RowOfBug(std::move(parts)).row());
      make_id_unique();
    }
    for (const CandidatesOfKind& g : groups_) {
      for (const Candidate& c : g.all) {
        if (!row_of_.contains(&c)) row_of_[&c] = row_of_range(c);
      }
    }
  }
  /// Of the simplest cases that are those of rows.
  void add_ranges() {
    std::set<std::string> of_rows;
    for (const TriagedSignature& s : triage_.signatures) of_rows.insert(s.simplest);
    for (const ExaminedFinding& f : parts_) {
      if (interrupted() || !f.has_cause() || of_rows.erase(f.examined->examined->file.string()) == 0) continue;
      use_measure(f.examined->filed->measure);
      const auto tick = [&](std::uint64_t) { settings_.tick("ranges of numbers", 0, of_rows.size()); };
      examined_.add_ranges(*f.examined->examined, *f.examined->filed->subject,
                           std::clamp(time_left(), Seconds(0), most_for_ranges), tick);
    }
  }
  /// Two bugs may have the same part, where their causes differ.
  void make_id_unique() {
    std::vector<TriagedSignature>& all = triage_.signatures;
    const auto is_taken = [&](const std::string& id) {
      return std::any_of(all.begin(), all.end() - 1, [&](const TriagedSignature& s) { return s.id == id; });
    };
    std::string& id = all.back().id;
    for (const std::string& name : all.back().names) {
      if (is_taken(id)) id = name;
    }
    for (int n = 2; is_taken(id); ++n) id = hash_of({id, std::to_string(n)});
    all.back().names.insert(id);
  }
  std::size_t row_of_range(const Candidate& c) {
    const std::string id = name_of_range(c.kind.query, c.kind.subject);
    std::vector<TriagedSignature>& all = triage_.signatures;
    const auto found = std::find_if(all.begin(), all.end(), [&](const TriagedSignature& s) { return s.id == id; });
    if (found != all.end()) return std::size_t(found - all.begin());
    TriagedSignature s;
    s.id = id;
    s.names = {id};
    s.kind = c.kind;
    s.version = c.filed->subject->version;
    s.asked_as = c.filed->subject->offering(s.kind.query).how;
    s.examined = true;
    s.range.emplace();
    s.may_stand = false;
    s.regions = c.variant.regions, s.branches = c.variant.branches;
    s.case_of_simplest = c.filed->question;
    s.simplest = c.filed->file.string();
    all.push_back(std::move(s));
    return all.size() - 1;
  }

  void add(const Candidate& c) {
    TriagedSignature& s = triage_.signatures[row_of_.at(&c)];
    s.reports.push_back(c.filed->file.string());
    s.ids.push_back(c.filed->id);
    s.cases.push_back(c.filed->question);
    ordinary_[s.id] += c.variant.ordinary;
    if (s.range) add_to_range(s, c);
    const auto worst = finding_of_.find(s.id);
    const double severity = severity_of(c.finding, c.size, 1);
    if (worst != finding_of_.end() && severity <= severity_of(worst->second, s.size, 1)) return;
    finding_of_[s.id] = c.finding;
    s.worst = c.filed->file.string();
    s.case_of_worst = c.filed->question;
    s.kind = c.kind;
    s.size = c.size;
    s.headline = c.headline;
  }
  void propose_conventions() {
    std::vector<CasesOfRow> rows(triage_.signatures.size());
    for (const CandidatesOfKind& g : groups_) {
      for (const Candidate& c : g.all) rows[row_of_.at(&c)].cases.push_back(&c);
    }
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].findings = triage_.signatures[i].findings;
    triage_.proposals = proposed_conventions(rows, workers_, [] { return !interrupted(); });
  }
  static void add_to_range(TriagedSignature& s, const Candidate& c) {
    s.range->add(*c.extreme);
    s.regions = common(s.regions, c.variant.regions);
    const FindingPart part{c.kind, {}};
    if (std::find(s.parts.begin(), s.parts.end(), part) == s.parts.end()) s.parts.push_back(part);
    if (plainness_of(c.filed->question) >= plainness_of(s.case_of_simplest)) return;
    s.case_of_simplest = c.filed->question;
    s.simplest = c.filed->file.string();
    s.branches = c.variant.branches;
  }
  static void describe_range(TriagedSignature& s) {
    if (!s.range) return;
    s.cause.text = fmt::format(
        "Only with numbers {}: the same scenes at ordinary magnitude are answered right. Such numbers are out of range "
        "where the documentation of the library states a domain.",
        borders_text(*s.range));
    s.cause.evidence = {{"The scene of each report was asked again at ordinary magnitude.",
                         fmt::format("The fault is gone in all of {}.", plural_text(s.reports.size(), "report"))}};
  }

  /// One finding for each report, and those that the indexes count beyond their reports.
  void count() {
    for (TriagedSignature& s : triage_.signatures) s.findings = s.reports.size();
    triage_.findings_right_now = triage_.right_now.size();
    std::map<Of, std::uint64_t> beyond;
    for (const CountedVariant& v : sources_.counts) {
      count_for(row_like(v), v.count.findings - v.count.kept, v.variant.ordinary);
      beyond[{v.kind.query, v.kind.subject}] += v.count.kept;
    }
    for (const FiledReport& r : sources_.reports) {
      std::uint64_t& kept = beyond[{std::string(r.question.query->name), r.subject->name}];
      if (r.is_counted && kept > 0) --kept;
    }
    for (const auto& [of, without_file] : beyond) count_for(largest_row(of), without_file, false);
    for (TriagedSignature& s : triage_.signatures) {
      s.ordinary_share = double(ordinary_[s.id]) / double(s.findings);
      s.severity = severity_of(finding_of_[s.id], s.size, s.ordinary_share);
    }
  }
  void count_for(TriagedSignature* row, std::uint64_t findings, bool ordinary) {
    (row != nullptr ? row->findings : triage_.findings_right_now) += findings;
    if (row != nullptr && ordinary) ordinary_[row->id] += findings;
  }
  /// The row of the report that is most like a counted variant; nullptr where the subject is right now.
  TriagedSignature* row_like(const CountedVariant& v) {
    const auto of_kind = [&](const CandidatesOfKind& g) { return g.kind == v.kind; };
    const auto of_class = [&](const CandidatesOfKind& g) { return class_of(g.kind, {}) == class_of(v.kind, {}); };
    if (const Candidate* c = most_alike_of(v, of_kind)) return &triage_.signatures[row_of_.at(c)];
    if (const Candidate* c = most_alike_of(v, of_class)) return &triage_.signatures[row_of_.at(c)];
    return nullptr;
  }
  template <class Fits>
  const Candidate* most_alike_of(const CountedVariant& v, const Fits& fits) const {
    const Candidate* best = nullptr;
    for (const CandidatesOfKind& g : groups_) {
      if (!fits(g)) continue;
      for (const Candidate& c : g.all) {
        if (best == nullptr || likeness(c, v.variant) > likeness(*best, v.variant)) best = &c;
      }
    }
    return best;
  }
  TriagedSignature* largest_row(const Of& of) {
    TriagedSignature* largest = nullptr;
    for (TriagedSignature& s : triage_.signatures) {
      const bool fits = std::any_of(s.parts.begin(), s.parts.end(),
                                    [&](const FindingPart& p) { return Of(p.kind.query, p.kind.subject) == of; });
      if (fits && (largest == nullptr || s.findings > largest->findings)) largest = &s;
    }
    return largest;
  }

  const Sources& sources_;
  const TriageSettings& settings_;
  Workers& workers_;
  ExaminedCases examined_;
  Clock::time_point begin_;
  Triage triage_;
  std::vector<CandidatesOfKind> groups_;
  std::vector<ExaminedFinding> parts_;
  std::map<const Candidate*, std::size_t> row_of_;
  std::map<std::string, std::uint64_t> ordinary_;  ///< by the id of the signature
  std::map<std::string, Finding> finding_of_;      ///< the worst one
};

}  // namespace

std::string_view name_of(SignatureChange c) {
  switch (c) {
    case SignatureChange::fresh: return "new";
    case SignatureChange::worse: return "worse";
    case SignatureChange::known: return "known";
    case SignatureChange::unproved: return "unproved";
    case SignatureChange::part_fixed: return "fixed in part";
    case SignatureChange::fixed: return "fixed";
  }
  return "?";
}

std::string_view name_of(SignatureDecision::Kind k) {
  switch (k) {
    case SignatureDecision::Kind::accepted: return "accepted";
    case SignatureDecision::Kind::upstream: return "upstream";
    case SignatureDecision::Kind::reported: return "reported";
    case SignatureDecision::Kind::fixed: return "fixed";
  }
  return "?";
}

bool TriagedSignature::stands() const {
  if (change == SignatureChange::fixed || !may_stand) return false;
  if (decision) return decision->reopened;
  return !change || change == SignatureChange::fresh || change == SignatureChange::worse;
}

Triage triage(const Sources& sources, const TriageSettings& settings, Workers& workers) {
  return Work(sources, settings, workers).result();
}

std::set<std::string> names_of_finding(const FindingPart& part, const Cause& cause) {
  std::set<std::string> names{name_of_class(part)};
  if (const std::string of_cause = name_of_cause(part.kind, cause); !of_cause.empty()) names.insert(of_cause);
  return names;
}

std::string name_of_wrong_now(const std::string& query, const std::string& subject) {
  return hash_of({"wrong now", query, subject});
}

std::string name_of_range(const std::string& query, const std::string& subject) {
  return hash_of({"range", query, subject});
}

bool share_a_name(const TriagedSignature& a, const TriagedSignature& b) {
  return std::any_of(a.names.begin(), a.names.end(), [&](const std::string& n) { return b.names.contains(n); });
}

void rank(std::vector<TriagedSignature>& signatures) {
  std::stable_sort(signatures.begin(), signatures.end(), [](const TriagedSignature& a, const TriagedSignature& b) {
    const auto key = [](const TriagedSignature& s) {
      const bool is_regression = s.change && s.stands() && is_ours(s.kind.subject);
      return std::tuple(!s.range, is_regression, s.change != SignatureChange::fixed, s.severity, s.findings);
    };
    return key(a) > key(b);
  });
}

}  // namespace nearmiss
