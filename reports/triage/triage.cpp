#include "reports/triage/triage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "oracles/confirmed.hpp"
#include "oracles/requirements.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/night_changes.hpp"
#include "reports/findings/hash.hpp"
#include "reports/findings/report_text.hpp"
#include "reports/findings/text.hpp"
#include "reports/triage/examination/examined_cases.hpp"

namespace nearmiss {

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// How many reports of a kind are minimised at most, and the most time for one of them.
constexpr std::size_t most_examined = 6;
constexpr Seconds most_for_one{16};

/// A report whose subject was asked again and still has a finding.
struct Candidate {
  const FiledReport* filed = nullptr;
  Finding finding;  ///< in full
  Variant variant;
  ErrorSize size;
  std::string headline;
  std::optional<ExaminedCase> examined;
};

/// The candidates of one kind. Those to be examined come first, in their order.
struct CandidatesOfKind {
  FindingKind kind;
  std::vector<Candidate> all;
  std::size_t to_examine = 0;
};

/// How much there is to read in a case: the digits of its numbers, each number once.
std::size_t digits_of(const Case& c) {
  std::set<double> numbers(c.values.begin(), c.values.end());
  std::size_t digits = 0;
  for (const double x : numbers) digits += number_text(x, c.scalar).size();
  return digits;
}

/// Asks the subject of a report again. Empty where it has no finding now.
std::optional<Candidate> asked_again(const FiledReport& r, Workers& workers, FindingKind& kind) {
  use_measure(r.measure);
  const Standard standard = r.subject->standard_for(r.question.query->name);
  Report now;
  now.question = r.question;
  now.subject = r.subject->name;
  now.answer = workers.ask(*r.subject, r.question);
  now.finding = confirmed(r.question, now.answer, standard, Detail::full);
  now.standard = standard;
  if (!is_bad(now.finding)) return std::nullopt;
  Candidate c{&r, now.finding, {}, error_size(r.question, now.finding), headline(now), {}};
  c.variant = {confirmed(r.question, now.answer, standard, Detail::verdict).branches, feature_regions_of(r.question),
               is_ordinary(r.question)};
  kind = kind_of_finding(*r.question.query, r.subject->name, now.finding);
  return c;
}

/// Moves the candidates that are to be examined to the front: the worst, the simplest, then one of each further
/// variant.
void choose(CandidatesOfKind& group) {
  std::vector<Candidate>& all = group.all;
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return std::tuple(a.size.relative, digits_of(b.filed->question)) >
           std::tuple(b.size.relative, digits_of(a.filed->question));
  });
  std::set<Variant> chosen{all.front().variant};
  const auto move_to_front = [&](std::size_t from) {
    std::rotate(all.begin() + std::ptrdiff_t(group.to_examine), all.begin() + std::ptrdiff_t(from),
                all.begin() + std::ptrdiff_t(from) + 1);
    chosen.insert(all[group.to_examine++].variant);
  };
  move_to_front(0);
  const auto simplest = std::min_element(all.begin() + 1, all.end(), [](const Candidate& a, const Candidate& b) {
    return digits_of(a.filed->question) < digits_of(b.filed->question);
  });
  if (simplest != all.end()) move_to_front(std::size_t(simplest - all.begin()));
  for (std::size_t i = group.to_examine; i < all.size() && group.to_examine < most_examined; ++i) {
    if (!chosen.contains(all[i].variant)) move_to_front(i);
  }
}

/// Causes that name no mechanism of arithmetic: what is wrong is told by the regions. The test of each looks at other
/// cases too, where another mistake may show, so that they do not tell rows apart. 0: any other cause; otherwise the
/// larger, the more it says.
int told_by_regions(CauseKind kind) {
  switch (kind) {
    case CauseKind::unexplained: return 1;
    case CauseKind::logic: return 2;
    case CauseKind::unsupported: return 3;
    default: return 0;
  }
}

/// The cause as a part of the signature, and its key.
std::string_view cause_in_signature(const TriagedSignature& s) {
  return told_by_regions(s.cause.kind) > 0 ? name_of(CauseKind::logic) : name_of(s.cause.kind);
}
std::string key_in_signature(const TriagedSignature& s) { return told_by_regions(s.cause.kind) > 0 ? "" : s.cause.key; }

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
    ask_again();
    for (CandidatesOfKind& g : groups_) choose(g);
    examine_groups();
    for (CandidatesOfKind& g : groups_) put_into_signatures(g);
    count();
    rank(triage_.signatures);
    return std::move(triage_);
  }

 private:
  Seconds time_left() const { return settings_.time - Seconds(Clock::now() - begin_); }

  void ask_again() {
    std::map<FindingKind, std::size_t> at;
    for (std::size_t i = 0; i < sources_.reports.size() && !interrupted(); ++i) {
      settings_.tick("asking again", i, sources_.reports.size());
      const FiledReport& r = sources_.reports[i];
      FindingKind kind;
      std::optional<Candidate> c = asked_again(r, workers_, kind);
      if (interrupted()) return;  // the answer may be that the worker gave up
      if (!c) {
        triage_.right_now.push_back(r);
        continue;
      }
      const auto [found, is_new] = at.try_emplace(kind, groups_.size());
      if (is_new) groups_.push_back({kind, {}, 0});
      groups_[found->second].all.push_back(std::move(*c));
    }
  }

  /// The first of every group, then the second of every group, and so on.
  void examine_groups() {
    std::size_t total = 0, done = 0;
    for (const CandidatesOfKind& g : groups_) total += g.to_examine;
    for (std::size_t turn = 0; turn < most_examined; ++turn) {
      for (CandidatesOfKind& g : groups_) {
        if (turn >= g.to_examine) continue;
        if (interrupted() || time_left() <= Seconds(0)) {
          triage_.all_examined = false;
          return;
        }
        examine(g.all[turn], g.kind, done++, total);
      }
    }
  }
  void examine(Candidate& c, const FindingKind& kind, std::size_t done, std::size_t total) {
    const std::string activity = fmt::format("examining {} of {}", kind.query, kind.subject);
    const auto tick = [&](std::uint64_t) { settings_.tick(activity, done, total); };
    tick(0);
    use_measure(c.filed->measure);
    c.examined = examined_.earlier(*c.filed);
    if (!c.examined) c.examined = examined_.examine(*c.filed, std::min(most_for_one, time_left()), tick);
  }

  /// The signature of an examined case; a new one where no other case had it.
  TriagedSignature& signature_of(const CandidatesOfKind& g, const Candidate& c) {
    TriagedSignature s;
    s.kind = g.kind;
    s.version = c.filed->subject->version;
    s.cause.text = "It was not looked for: the time was over.";
    s.regions = c.variant.regions;
    s.branches = c.variant.branches;
    if (c.examined) {
      s.examined = true;
      s.cause = c.examined->cause, s.branches = c.examined->branches, s.regions = c.examined->regions;
    }
    s.id = id_of(s);
    std::vector<TriagedSignature>& all = triage_.signatures;
    auto same = std::find_if(all.begin(), all.end(), [&](const TriagedSignature& o) { return o.id == s.id; });
    if (same == all.end() && s.cause.key.empty()) {
      same =
          std::find_if(all.begin(), all.end(), [&](const TriagedSignature& o) { return differs_in_key_alone(o, s); });
    }
    if (same != all.end()) {
      if (told_by_regions(s.cause.kind) > told_by_regions(same->cause.kind)) same->cause = s.cause;
      return *same;
    }
    s.case_of_simplest = c.examined ? c.examined->simplest : c.filed->question;
    s.simplest = c.examined ? c.examined->file.string() : c.filed->file.string();
    all.push_back(std::move(s));
    return all.back();
  }
  void put_into_signatures(const CandidatesOfKind& g) {
    std::vector<const Candidate*> examined;
    for (const Candidate& c : g.all) {
      if (c.examined) examined.push_back(&c);
    }
    // A cause without a key joins a signature that has one.
    for (const Candidate* e : examined) {
      if (!e->examined->cause.key.empty()) signature_of(g, *e);
    }
    for (const Candidate& c : g.all) {
      const Candidate* like = c.examined ? &c : most_alike(examined, c.variant);
      add(signature_of(g, like != nullptr ? *like : g.all.front()), c);
    }
    for (const Candidate* e : examined) use_simpler(signature_of(g, *e), *e);
    like_[g.kind] = std::move(examined);
  }
  static void use_simpler(TriagedSignature& s, const Candidate& c) {
    if (digits_of(c.examined->simplest) >= digits_of(s.case_of_simplest)) return;
    s.case_of_simplest = c.examined->simplest;
    s.simplest = c.examined->file.string();
  }
  /// The examined case whose regions a case has, and the most of them; of the same variant where there is one. The
  /// first one where no case has its regions; nullptr where none was examined.
  static const Candidate* most_alike(const std::vector<const Candidate*>& examined, const Variant& variant) {
    const Candidate* best = nullptr;
    const auto rank_of = [&](const Candidate& c) {
      const bool within = c.examined->regions.within(variant.regions);
      return std::tuple(c.variant == variant, within && c.variant.ordinary == variant.ordinary, within,
                        within ? c.examined->regions.names().size() : 0, c.variant.branches == variant.branches);
    };
    for (const Candidate* c : examined) {
      if (best == nullptr || rank_of(*c) > rank_of(*best)) best = c;
    }
    return best;
  }
  void add(TriagedSignature& s, const Candidate& c) {
    s.reports.push_back(c.filed->file.string());
    s.ids.push_back(c.filed->id);
    const bool is_worst = s.worst.empty() || c.size.relative > s.size.relative;
    ordinary_[s.id] += is_ordinary(c.filed->question);
    finding_of_[s.id] = is_worst ? c.finding : finding_of_[s.id];
    if (!is_worst) return;
    s.worst = c.filed->file.string();
    s.size = c.size;
    s.headline = c.headline;
  }

  /// The numbers of findings: those of the indexes where the kind is in one, otherwise those of the reports.
  void count() {
    struct Sum {
      std::uint64_t findings = 0, ordinary = 0;
    };
    std::map<std::string, Sum> counted;
    for (const CountedVariant& v : sources_.counts) {
      const TriagedSignature* s = signature_for(v);
      if (s == nullptr) continue;
      Sum& sum = counted[s->id];
      sum.findings += v.count.findings;
      if (v.variant.ordinary) sum.ordinary += v.count.findings;
    }
    for (TriagedSignature& s : triage_.signatures) {
      const Sum& sum = counted[s.id];
      const bool is_counted = sum.findings >= s.reports.size();
      s.findings = is_counted ? sum.findings : s.reports.size();
      s.ordinary_share = double(is_counted ? sum.ordinary : ordinary_[s.id]) / double(s.findings);
      s.severity = severity_of(finding_of_[s.id], s.size, s.ordinary_share);
    }
  }
  const TriagedSignature* signature_for(const CountedVariant& v) {
    const auto group =
        std::find_if(groups_.begin(), groups_.end(), [&](const CandidatesOfKind& g) { return g.kind == v.kind; });
    if (group == groups_.end()) return nullptr;
    const Candidate* like = most_alike(like_[v.kind], v.variant);
    return &signature_of(*group, like != nullptr ? *like : group->all.front());
  }

  const Sources& sources_;
  const TriageSettings& settings_;
  Workers& workers_;
  ExaminedCases examined_;
  Clock::time_point begin_;
  Triage triage_;
  std::vector<CandidatesOfKind> groups_;
  std::map<FindingKind, std::vector<const Candidate*>> like_;
  std::map<std::string, std::uint64_t> ordinary_;  ///< by the id of the signature
  std::map<std::string, Finding> finding_of_;      ///< the worst one
};

}  // namespace

std::string_view name_of(SignatureChange c) {
  switch (c) {
    case SignatureChange::fresh: return "new";
    case SignatureChange::worse: return "worse";
    case SignatureChange::known: return "known";
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
  if (change == SignatureChange::fixed) return false;
  if (decision) return decision->reopened;
  return change != SignatureChange::known;
}

Triage triage(const Sources& sources, const TriageSettings& settings, Workers& workers) {
  return Work(sources, settings, workers).result();
}

std::string id_of(const TriagedSignature& s) {
  Fnv1a fnv;
  for (const std::string* part : {&s.kind.query, &s.kind.subject, &s.kind.fault, &s.kind.member, &s.kind.clause}) {
    fnv.add(*part);
  }
  if (s.examined) fnv.add(cause_in_signature(s));
  fnv.add(key_in_signature(s));
  fnv.add(fmt::format("{:x} {}", s.branches, fmt::join(s.regions.names(), ",")));
  return fnv.id();
}

bool differs_in_key_alone(const TriagedSignature& a, const TriagedSignature& b) {
  return a.kind == b.kind && a.examined && b.examined && cause_in_signature(a) == cause_in_signature(b) &&
         a.branches == b.branches && a.regions == b.regions &&
         (key_in_signature(a).empty() || key_in_signature(b).empty());
}

void rank(std::vector<TriagedSignature>& signatures) {
  std::stable_sort(signatures.begin(), signatures.end(), [](const TriagedSignature& a, const TriagedSignature& b) {
    const auto key = [](const TriagedSignature& s) {
      const bool is_regression = s.change && s.stands() && is_ours(s.kind.subject);
      return std::tuple(is_regression, s.change != SignatureChange::fixed, s.severity);
    };
    return key(a) > key(b);
  });
}

}  // namespace nearmiss
