#include "reports/triage/comparison/baseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <tuple>

#include "corpus/files/file_value.hpp"
#include "corpus/storage/codec.hpp"
#include "oracles/confirmed.hpp"
#include "oracles/requirements.hpp"
#include "oracles/scene_limits.hpp"
#include "reports/engine/replay.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/text.hpp"
#include "reports/triage/candidates.hpp"
#include "reports/triage/comparison/rates.hpp"
#include "reports/triage/triage_json.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

/// The finding of the subject's answer to a case now; empty where it cannot be asked.
std::optional<Finding> finding_now(const Case& question, const FindingKind& kind, Workers& workers) {
  const Subject* subject = find_subject(kind.subject);
  const std::optional<Case> c = subject == nullptr ? std::nullopt : in_scalar(question, subject->scalar);
  if (!c || subject->offering(question.query->name).answer == nullptr) return std::nullopt;
  return confirmed(*c, workers.ask(*subject, *c), subject->standard_for(question.query->name), Detail::full);
}

/// The class of what is wrong now, without its regions; empty where nothing is.
std::optional<FindingClass> class_now(const std::optional<Finding>& f, const Case& question, const FindingKind& kind) {
  if (!f || !is_bad(*f)) return std::nullopt;
  return class_of(kind_of_finding(*question.query, kind.subject, *f), {});
}

bool has_part_of(const TriagedSignature& s, const FindingClass& c) {
  return std::any_of(s.parts.begin(), s.parts.end(), [&](const FindingPart& p) { return class_of(p.kind, {}) == c; });
}

bool has_part_of(const TriagedSignature& s, const std::string& query, const std::string& subject) {
  return std::any_of(s.parts.begin(), s.parts.end(),
                     [&](const FindingPart& p) { return p.kind.query == query && p.kind.subject == subject; });
}

/// The cases that a row keeps, or those of its reports that can still be read; with the simplest and the worst.
std::vector<Case> cases_of(const TriagedSignature& s) {
  std::vector<Case> all = s.cases;
  all.push_back(s.case_of_simplest);
  if (s.case_of_worst) all.push_back(*s.case_of_worst);
  for (const std::string& file : s.cases.empty() ? s.reports : std::vector<std::string>()) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) continue;
    try {
      all.push_back(read_case_or_report(file));
    } catch (const BadInput&) {  // the file has become another one; the simplest case is left
    }
  }
  return all;
}

/// Asks several times: right is what is right each time.
std::optional<Finding> worst_finding_now(const Case& question, const FindingKind& kind, Workers& workers) {
  constexpr int times = 3;
  std::optional<Finding> f;
  for (int i = 0; i < times && (!f || !is_bad(*f)); ++i) {
    f = finding_now(question, kind, workers);
    if (!f) return f;
  }
  return f;
}

/// Asks the subject the cases of a row of the baseline; empty where it cannot be asked.
std::optional<CasesNow> cases_now(const TriagedSignature& earlier, const std::vector<TriagedSignature>& all,
                                  Workers& workers) {
  CasesNow now;
  for (const Case& c : cases_of(earlier)) {
    const std::optional<Finding> f = worst_finding_now(c, earlier.kind, workers);
    if (!f) return std::nullopt;
    ++now.asked;
    const std::optional<FindingClass> wrong = class_now(f, c, earlier.kind);
    const auto has_it = [&](const TriagedSignature& s) { return has_part_of(s, *wrong); };
    if (wrong && has_it(earlier)) {
      ++now.wrong;
    } else if (!wrong || std::any_of(all.begin(), all.end(), has_it)) {
      ++now.gone;
    }
  }
  return now;
}

/// A row of the baseline that has no signature now.
void add_absent(const TriagedSignature& earlier, const CasesNow& cases, Triage& now) {
  TriagedSignature s = earlier;
  s.change = cases.is_fixed() ? SignatureChange::fixed : SignatureChange::known;
  s.why.clear();
  s.decision.reset();
  s.findings = 0;
  s.reports.clear(), s.ids.clear(), s.worst.clear();
  std::error_code error;
  if (!fs::is_regular_file(s.simplest, error)) s.simplest.clear();
  now.signatures.push_back(std::move(s));
}

/// A subject whose answers may be late at one time and not at another.
bool depends_on_time(const FindingKind& kind) { return kind.clause.starts_with("no answer within"); }

/// How the rate of a row's findings has changed: that of its part with the least chance.
struct Rise {
  FindingRate before, now;
  double chance = 1;  ///< of so many findings without a rise; 0 where the cases are the same
  bool is_proved = false, is_of_same_cases = false;

  std::string text() const {
    const std::string cases = plural_text(now.cases, "case");
    if (before.cases == 0) return fmt::format("{} of {}", count_text(now.findings), cases);
    if (is_of_same_cases)
      return fmt::format("{} of the {} of the baseline, then {}", count_text(now.findings), cases,
                         count_text(before.findings));
    return fmt::format("{} of {}; {} of {} in the baseline", count_text(now.findings), cases,
                       count_text(before.findings), count_text(before.cases));
  }
};

/// One comparison. Rows of now are given by their index.
class Comparison {
 public:
  Comparison(const Baseline& before, const BaselineNow& asked, Triage& now, const TriageSettings& settings,
             Workers& workers)
      : before_(before),
        asked_(asked),
        now_(now),
        settings_(settings),
        workers_(workers),
        here_(now.signatures.size()),
        match_(here_) {
    for (const TriagedSignature& s : now.signatures) tests_ += s.parts.size();
  }

  std::vector<std::string> result() {
    match();
    for (std::size_t i = 0; i < here_; ++i) set_change(i);
    add_wrong_now();
    for (std::size_t i = 0; i < here_; ++i) set_rise(i);
    std::set<std::string> cannot_be_asked;
    for (std::size_t k = 0; k < before_.rows.size(); ++k) {
      const TriagedSignature& earlier = before_.rows[k];
      const bool here = is_here(earlier);
      if (!asked_.rows[k] && !here) cannot_be_asked.insert(earlier.kind.subject);
      if (asked_.rows[k] && (asked_.rows[k]->is_fixed() || !here)) add_absent(earlier, *asked_.rows[k], now_);
    }
    set_part_fixed();
    rank(now_.signatures);
    return {cannot_be_asked.begin(), cannot_be_asked.end()};
  }

 private:
  TriagedSignature& row(std::size_t i) { return now_.signatures[i]; }

  using Of = BaselineNow::Of;

  /// The better two rows fit, the larger; 0: they share no name.
  static std::size_t fit(const TriagedSignature& a, const TriagedSignature& b) {
    const auto shared =
        std::count_if(a.names.begin(), a.names.end(), [&](const std::string& n) { return b.names.contains(n); });
    return shared == 0 ? 0 : 2 * std::size_t(shared) + (a.id == b.id ? 1 : 0);
  }
  /// Each row of the baseline has at most one row of now, and the other way around; the best fit first.
  void match() {
    std::vector<std::tuple<std::size_t, std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < here_; ++i) {
      for (std::size_t k = 0; k < before_.rows.size(); ++k) {
        const std::size_t f = asked_.rows[k] && asked_.rows[k]->is_fixed() ? 0 : fit(row(i), before_.rows[k]);
        if (f > 0) pairs.emplace_back(f, i, k);
      }
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const auto& a, const auto& b) { return std::get<0>(a) > std::get<0>(b); });
    std::set<std::size_t> taken;
    for (const auto& [f, i, k] : pairs) {
      if (match_[i] != nullptr || taken.contains(k)) continue;
      match_[i] = &before_.rows[k];
      taken.insert(k);
    }
  }
  bool is_here(const TriagedSignature& earlier) {
    return std::any_of(now_.signatures.begin(), now_.signatures.begin() + std::ptrdiff_t(here_),
                       [&](const TriagedSignature& s) { return share_a_name(s, earlier); });
  }

  /// Of the same cases, where they were asked again: one finding more is a proof. Otherwise of the cases of both runs.
  Rise rise_of(const FindingPart& part) const {
    Rise r{before_.sample.rate_of(part.kind, part.regions), now_.sample.rate_of(part.kind, part.regions)};
    if (r.before.cases == 0 || r.now.cases == 0) return r;
    const FindingRate again = asked_.again.rate_of(part.kind, part.regions);
    if (again.cases > 0 && again.findings > r.before.findings && !depends_on_time(part.kind))
      return {r.before, again, 0, true, true};
    r.chance = chance_without_rise(r.before, r.now);
    r.is_proved = r.chance < error_of_a_comparison / double(tests_);
    return r;
  }
  Rise rise_of(const TriagedSignature& s) const {
    Rise most;
    for (const FindingPart& part : s.parts) {
      const Rise r = rise_of(part);
      const bool is_first = &part == &s.parts.front();
      if (is_first || r.chance < most.chance || (r.chance == most.chance && r.now.findings > most.now.findings))
        most = r;
    }
    return most;
  }
  /// More answers to the query are wrong than before. An answer that is wrong in two ways has one fault, its worst: so
  /// the mend of one mistake may show more findings of another.
  bool has_more_findings(const FindingKind& kind, const Rise& rise) const {
    const Sample& later = rise.is_of_same_cases ? asked_.again : now_.sample;
    const FindingRate before = before_.sample.rate_of(kind.query, kind.subject),
                      now = later.rate_of(kind.query, kind.subject);
    return double(now.findings) * double(before.cases) > double(before.findings) * double(now.cases);
  }

  bool is_known_by_name(std::size_t i) {
    return std::any_of(before_.rows.begin(), before_.rows.end(),
                       [&](const TriagedSignature& earlier) { return share_a_name(row(i), earlier); });
  }
  bool was_asked(const TriagedSignature& s) const { return before_.sample.asked_of(s.kind.query, s.kind.subject) > 0; }

  void set_change(std::size_t i) {
    TriagedSignature& s = row(i);
    if (match_[i] != nullptr) {
      s.change = SignatureChange::known;
      s.names.insert(match_[i]->id);  // a decision about it still holds
      if (errs_more(*match_[i], s)) s.change = SignatureChange::worse;
      return;
    }
    const Rise rise = rise_of(s);
    s.why = rise.text();
    if (rise.is_proved && (rise.before.findings == 0 || has_more_findings(s.kind, rise))) {
      s.change = SignatureChange::fresh;
    } else if (is_known_by_name(i) || rise.before.findings > 0) {
      s.change = SignatureChange::known;
    } else {
      s.change = !was_asked(s) || is_promise_broken(s) ? SignatureChange::fresh : SignatureChange::unproved;
    }
  }
  /// The subject promises exact answers, and kept its promise in the baseline: in every query, because one that has
  /// mistakes may have rare ones, too.
  bool is_promise_broken(const TriagedSignature& s) const {
    const Subject* subject = find_subject(s.kind.subject);
    const auto& all = before_.sample.findings;
    if (std::any_of(all.begin(), all.end(), [&](const auto& f) { return f.first.subject == s.kind.subject; }))
      return false;
    return subject != nullptr && subject->standard_for(s.kind.query).promised;
  }
  /// A known row whose findings are more frequent, which no new row explains.
  void set_rise(std::size_t i) {
    TriagedSignature& s = row(i);
    if (match_[i] == nullptr || s.range) return;
    for (const FindingPart& part : s.parts) {
      const Rise rise = rise_of(part);
      if (!rise.is_proved || !has_more_findings(part.kind, rise) || is_explained_by_new_row(part)) continue;
      s.change = SignatureChange::worse;
      s.why = rise.text();
    }
  }
  bool is_explained_by_new_row(const FindingPart& part) {
    return std::any_of(now_.signatures.begin(), now_.signatures.end(), [&](const TriagedSignature& s) {
      return s.change == SignatureChange::fresh && has_part_of(s, class_of(part.kind, {}));
    });
  }

  /// A row for the cases of the baseline's run that were right and are wrong now, of a query and a subject without a
  /// new row. They lie in a row that the baseline has: two mistakes of one kind may need the same regions.
  void add_wrong_now() {
    for (const auto& [of, cases] : asked_.wrong_now) {
      const bool is_told = std::any_of(now_.signatures.begin(), now_.signatures.end(), [&](const auto& s) {
        return s.change == SignatureChange::fresh && !s.range && has_part_of(s, of.first, of.second);
      });
      if (is_told || !has_more_wrong(of)) continue;
      std::optional<TriagedSignature> row = row_of_wrong_now(of, in_order(cases));
      if (row) now_.signatures.push_back(std::move(*row));
    }
  }
  /// More cases have become wrong than right. The mend of one mistake may show another where it hid it: these are
  /// fewer.
  bool has_more_wrong(const Of& of) const {
    const auto right = asked_.right_now.find(of);
    return right == asked_.right_now.end() || asked_.wrong_now.at(of).size() > right->second;
  }
  /// Ordinary scenes first, then the plainest.
  static std::vector<Case> in_order(std::vector<Case> cases) {
    std::stable_sort(cases.begin(), cases.end(), [](const Case& a, const Case& b) {
      return std::pair(is_extreme_scene(a), plainness_of(a)) < std::pair(is_extreme_scene(b), plainness_of(b));
    });
    return cases;
  }
  /// The case with its finding; empty where it is not wrong each time, and where the finding is one of extreme scenes
  /// alone.
  std::optional<Candidate> wrong_each_time(const Case& c, const Subject& subject) {
    const FiledReport filed{"", "", c, &subject, before_.measure.value_or(SceneMeasure())};
    std::optional<Candidate> wrong = asked_again(filed, workers_);
    const bool is_kept = wrong && !wrong->extreme && asked_again(filed, workers_);
    return is_kept ? wrong : std::nullopt;
  }
  /// Empty where no case is wrong each time.
  std::optional<TriagedSignature> row_of_wrong_now(const Of& of, const std::vector<Case>& cases) {
    constexpr std::size_t most_kept = 32;
    TriagedSignature s;
    for (const Case& c : cases) {
      const std::optional<Candidate> wrong = wrong_each_time(c, *find_subject(of.second));
      if (!wrong) continue;
      if (s.cases.empty()) describe_wrong_now(c, *wrong, *find_subject(of.second), s);
      s.cases.push_back(c);
      const FindingPart part{wrong->kind, {}};
      if (std::find(s.parts.begin(), s.parts.end(), part) == s.parts.end()) s.parts.push_back(part);
      if (s.cases.size() == most_kept) break;
    }
    if (s.cases.empty()) return std::nullopt;
    s.id = name_of_wrong_now(of.first, of.second);
    s.names = {s.id};
    s.change = SignatureChange::fresh;
    s.why = fmt::format("{} of the baseline's run: right then, wrong now", plural_text(cases.size(), "case"));
    return s;
  }
  /// The plainest case, its error and its cause.
  void describe_wrong_now(const Case& c, const Candidate& wrong, const Subject& subject, TriagedSignature& s) {
    s.kind = wrong.kind;
    s.version = subject.version;
    s.asked_as = subject.offering(c.query->name).how;
    s.size = wrong.size;
    s.severity = severity_of(wrong.finding, wrong.size, 1);
    s.headline = wrong.headline;
    s.branches = wrong.variant.branches;
    s.case_of_simplest = c;
    s.cause.text =
        "It was not looked for: the baseline has such findings in other cases, and those near by may be among them.";
    if (settings_.folder.empty()) return;
    Report r = examine(c, subject, workers_);
    const fs::path file = settings_.folder / "simplest" / c.query->name /
                          fmt::format("{}-{}-{}.json", r.subject, fault_of(r.finding), id_of(r));
    r.replay = replay_command(subject, file.string());
    make_folder(file.parent_path());
    write_file(file, pretty_json(report_to_json(r)));
    s.simplest = file.string();
  }

  /// What was fixed beside a mistake that is there still: rows of the baseline with cases that are right now.
  void set_part_fixed() {
    for (std::size_t k = 0; k < before_.rows.size(); ++k) {
      const TriagedSignature& earlier = before_.rows[k];
      if (!asked_.rows[k] || earlier.range || depends_on_time(earlier.kind)) continue;
      const CasesNow& c = *asked_.rows[k];
      if (c.is_part_fixed()) {
        set_part_fixed(earlier, fmt::format("{} of the {} of the baseline: gone", count_text(c.gone),
                                            plural_text(c.asked, "kept case")));
      } else {
        note_smaller_error(earlier);
      }
    }
    for (const auto& [of, cases] : asked_.right_now) {
      if (cases == 0 || has_breakages(of) || is_fixed_in_part(of)) continue;
      if (const TriagedSignature* earlier = most_reduced(of))
        set_part_fixed(*earlier, fmt::format("{} of the run of the baseline: right now", plural_text(cases, "case")));
    }
  }
  /// The known row of now that is this row of the baseline.
  void set_part_fixed(const TriagedSignature& earlier, const std::string& why) {
    const auto is_same = [&](const TriagedSignature& s) {
      return s.change == SignatureChange::known && share_a_name(s, earlier);
    };
    const auto found = std::find_if(now_.signatures.begin(), now_.signatures.end(), is_same);
    if (found == now_.signatures.end()) return;
    found->change = SignatureChange::part_fixed;
    found->why = why;
  }
  /// Breakages may come and go with the state of a process.
  bool has_breakages(const Of& of) const {
    const auto& all = before_.sample.findings;
    return std::any_of(all.begin(), all.end(), [&](const auto& found) {
      return Of(found.first.query, found.first.subject) == of && !found.first.breakage.empty();
    });
  }
  bool is_fixed_in_part(const Of& of) const {
    const auto& all = now_.signatures;
    return std::any_of(all.begin(), all.end(), [&](const TriagedSignature& s) {
      const bool is_fixed = s.change == SignatureChange::part_fixed || s.change == SignatureChange::fixed;
      return is_fixed && has_part_of(s, of.first, of.second);
    });
  }
  /// The row of the baseline with the part that has lost the most findings.
  const TriagedSignature* most_reduced(const Of& of) const {
    const TriagedSignature* most = nullptr;
    double largest = 0;
    for (const TriagedSignature& s : before_.rows) {
      if (s.range || !has_part_of(s, of.first, of.second)) continue;
      for (const FindingPart& p : s.parts) {
        const double lost = double(before_.sample.rate_of(p.kind, p.regions).findings) -
                            double(asked_.again.rate_of(p.kind, p.regions).findings);
        if (most != nullptr && lost <= largest) continue;
        most = &s, largest = lost;
      }
    }
    return most;
  }
  /// The size of the error of the worst case of the baseline now; empty where it has not the row's fault any more.
  std::optional<double> size_of_worst(const TriagedSignature& earlier) {
    if (!earlier.case_of_worst || earlier.size.relative == 0 || earlier.range) return std::nullopt;
    const std::optional<Finding> f = finding_now(*earlier.case_of_worst, earlier.kind, workers_);
    const std::optional<FindingClass> wrong = class_now(f, *earlier.case_of_worst, earlier.kind);
    if (!wrong || !has_part_of(earlier, *wrong)) return std::nullopt;
    return error_size(*earlier.case_of_worst, *f).relative;
  }
  static std::string sizes_text(const TriagedSignature& earlier, double now) {
    return fmt::format("the worst case of the baseline errs by {}, then by {}", share_text(now),
                       share_text(earlier.size.relative));
  }
  /// The subject, asked the worst case of the baseline again, errs by much more than then.
  bool errs_more(const TriagedSignature& earlier, TriagedSignature& now) {
    const std::optional<double> size = size_of_worst(earlier);
    if (!size || *size < much_worse * earlier.size.relative) return false;
    now.why = sizes_text(earlier, *size);
    return true;
  }
  /// It errs by much less.
  void note_smaller_error(const TriagedSignature& earlier) {
    const std::optional<double> size = size_of_worst(earlier);
    if (size && much_worse * *size <= earlier.size.relative) set_part_fixed(earlier, sizes_text(earlier, *size));
  }

  const Baseline& before_;
  const BaselineNow& asked_;
  Triage& now_;
  const TriageSettings& settings_;
  Workers& workers_;
  std::size_t here_;
  std::vector<const TriagedSignature*> match_;  ///< rows of the baseline, by the index of the row
  std::size_t tests_ = 0;
};

/// Rows, by kind, of the reports whose subject is right now.
void add_right_now(const Triage& t, std::vector<TriagedSignature>& rows) {
  for (const FiledReport& r : t.right_now) {
    const nlohmann::json j = parse_json(read_file(r.file), r.file.string());
    const FileValue report(j, r.file.string());
    TriagedSignature s;
    s.kind = kind_in_report(report);
    s.parts = {{s.kind, {}}};
    s.names = names_of_finding(s.parts.front(), s.cause);
    s.id = *s.names.begin();
    const auto same = std::find_if(rows.begin(), rows.end(), [&](const auto& o) { return o.id == s.id; });
    if (same != rows.end()) {
      same->reports.push_back(r.file.string());
      same->cases.push_back(r.question);
      continue;
    }
    s.version = report.at("subject").at("version").text();
    s.headline = report.at("headline").text();
    s.cause.text = "It was not looked for: the subject is right now.";
    s.case_of_simplest = r.question;
    s.cases = {r.question};
    s.reports = {r.file.string()};
    rows.push_back(std::move(s));
  }
}

/// The numbers of a version: "FCL 0.7.0" is 0, 7, 0.
std::vector<std::uint64_t> numbers_of(const std::string& version) {
  std::vector<std::uint64_t> numbers;
  for (const char *at = version.data(), *end = at + version.size(); at != end;) {
    std::uint64_t n = 0;
    const auto [next, error] = std::from_chars(at, end, n);
    if (error == std::errc()) numbers.push_back(n);
    at = next == at ? at + 1 : next;
  }
  return numbers;
}

bool is_open_again(const SignatureDecision& d, const TriagedSignature& s) {
  if (s.change == SignatureChange::fixed) return false;
  if (d.kind == SignatureDecision::Kind::fixed) return numbers_of(s.version) >= numbers_of(d.argument);
  return d.bound && s.size.relative >= much_worse * *d.bound;
}

/// "N %" behind the word at; the share.
double bound_in(std::istringstream& words, const std::string& where) {
  std::string number, sign;
  words >> number;
  if (number.ends_with('%')) {
    number.pop_back();
    sign.push_back('%');
  } else {
    words >> sign;
  }
  double percent = -1;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), percent);
  if (error != std::errc() || end != number.data() + number.size() || percent < 0 || sign != "%")
    throw BadInput(fmt::format("{}: 'at' needs a size in percent, such as 'at 0.5 %'", where));
  return percent / 100;
}

SignatureDecision decision_in(const std::string& line, const std::string& where) {
  const std::size_t hash = line.find('#');
  std::istringstream words(line.substr(0, hash));
  SignatureDecision d;
  std::string kind, word;
  words >> d.id >> kind;
  const bool is_id = d.id.size() == 12 && d.id.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (!is_id) throw BadInput(fmt::format("{}: '{}' is no id of twelve hexadecimal digits", where, one_line(d.id, 40)));
  bool known = false;
  for (const auto k : {SignatureDecision::Kind::accepted, SignatureDecision::Kind::upstream,
                       SignatureDecision::Kind::reported, SignatureDecision::Kind::fixed}) {
    if (kind == name_of(k)) d.kind = k, known = true;
  }
  if (!known) {
    throw BadInput(
        fmt::format("{}: '{}' is none of accepted, upstream, reported URL, fixed VERSION", where, one_line(kind, 40)));
  }
  const bool has_argument = d.kind == SignatureDecision::Kind::reported || d.kind == SignatureDecision::Kind::fixed;
  if (has_argument && !(words >> d.argument)) {
    throw BadInput(
        fmt::format("{}: {} needs a {}", where, kind, d.kind == SignatureDecision::Kind::fixed ? "version" : "URL"));
  }
  if (words >> word) {
    if (word != "at")
      throw BadInput(fmt::format("{}: unexpected '{}'; a reason begins with #", where, one_line(word, 40)));
    d.bound = bound_in(words, where);
    if (words >> word)
      throw BadInput(fmt::format("{}: unexpected '{}'; a reason begins with #", where, one_line(word, 40)));
  }
  if (hash != std::string::npos) {
    const std::size_t begin = line.find_first_not_of(" \t", hash + 1);
    if (begin != std::string::npos) d.note = line.substr(begin);
  }
  return d;
}

}  // namespace

bool Baseline::has_asked(const std::string& query, const std::string& subject) const {
  if (!sample.empty()) return sample.asked_of(query, subject) > 0;
  return std::any_of(rows.begin(), rows.end(),
                     [&](const TriagedSignature& s) { return has_part_of(s, query, subject); });
}

Baseline read_baseline(const std::string& name, const TriageSettings& settings, Workers& workers) {
  std::error_code error;
  fs::path file = name;
  if (fs::is_directory(name, error)) file = fs::path(name) / "triage" / "triage.json";
  if (fs::is_regular_file(file, error)) {
    const nlohmann::json j = parse_json(read_file(file), file.string());
    Baseline before{signatures_from_json(j, file.string()), sample_in_triage(j, file.string()),
                    measure_in_triage(j, file.string())};
    std::erase_if(before.rows, [](const TriagedSignature& s) { return s.change == SignatureChange::fixed; });
    return before;
  }
  const Sources sources = read_sources({name});
  name_skipped(sources);
  Triage earlier = triage(sources, settings, workers);
  Baseline before{std::move(earlier.signatures), std::move(earlier.sample), earlier.measure};
  add_right_now(earlier, before.rows);
  return before;
}

BaselineNow ask_baseline(const Baseline& baseline, const std::vector<BaselineNow::Of>& order,
                         const TriageSettings& settings, Workers& workers) {
  BaselineNow now;
  if (baseline.measure) use_measure(*baseline.measure);
  for (const TriagedSignature& row : baseline.rows) {
    settings.tick("asking the baseline again", now.rows.size(), baseline.rows.size());
    now.rows.push_back(cases_now(row, baseline.rows, workers));
  }
  if (!can_be_drawn_again(baseline.sample)) return now;
  const auto until =
      std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(settings.time);
  std::size_t done = 0;
  for (const BaselineNow::Of& of : order) {
    const Subject* subject = find_subject(of.second);
    if (subject == nullptr) continue;
    const auto tick = [&] { settings.tick("asking the baseline again", done, baseline.sample.asked.size()); };
    std::optional<AskedAgain> again = asked_again(baseline.sample, of.first, *subject, until, tick);
    ++done;
    now.all_again = now.all_again && again && again->is_whole;
    if (!again) continue;
    now.again.asked.merge(again->sample.asked);
    now.again.findings.merge(again->sample.findings);
    now.wrong_now[of] = std::move(again->wrong_now);
    now.right_now[of] = again->right_now;
  }
  return now;
}

std::vector<std::string> compare_with(const Baseline& baseline, const BaselineNow& asked, Triage& now,
                                      const TriageSettings& settings, Workers& workers) {
  return Comparison(baseline, asked, now, settings, workers).result();
}

std::vector<std::string> compare_with(const Baseline& baseline, Triage& now, const TriageSettings& settings,
                                      Workers& workers) {
  std::vector<std::pair<double, BaselineNow::Of>> by_chance;
  for (const auto& [of, asked] : baseline.sample.asked) {
    if (now.sample.asked_of(of.first, of.second) == 0) continue;
    by_chance.emplace_back(
        chance_without_rise(baseline.sample.rate_of(of.first, of.second), now.sample.rate_of(of.first, of.second)), of);
  }
  std::sort(by_chance.begin(), by_chance.end());
  std::vector<BaselineNow::Of> order;
  for (auto& [chance, of] : by_chance) order.push_back(std::move(of));
  return compare_with(baseline, ask_baseline(baseline, order, settings, workers), now, settings, workers);
}

std::vector<SignatureDecision> decisions_in(const std::string& text, const std::string& where) {
  std::vector<SignatureDecision> all;
  std::istringstream lines(text);
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#') continue;
    const std::string here = fmt::format("{}:{}", where, number);
    SignatureDecision d = decision_in(line, here);
    if (std::any_of(all.begin(), all.end(), [&](const SignatureDecision& o) { return o.id == d.id; }))
      throw BadInput(fmt::format("{}: there is a decision about {} already", here, d.id));
    all.push_back(std::move(d));
  }
  return all;
}

std::vector<std::string> apply(const std::vector<SignatureDecision>& decisions, Triage& now) {
  std::vector<std::string> unknown;
  for (const SignatureDecision& d : decisions) {
    bool found = false;
    for (TriagedSignature& s : now.signatures) {
      if (!s.names.contains(d.id)) continue;
      found = true;
      s.decision = d;
      s.decision->reopened = is_open_again(d, s);
    }
    if (!found) unknown.push_back(d.id);
  }
  rank(now.signatures);
  return unknown;
}

}  // namespace nearmiss
