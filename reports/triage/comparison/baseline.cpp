#include "reports/triage/comparison/baseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "corpus/files/file_value.hpp"
#include "corpus/storage/codec.hpp"
#include "oracles/confirmed.hpp"
#include "oracles/requirements.hpp"
#include "reports/engine/replay.hpp"
#include "reports/findings/text.hpp"
#include "reports/triage/triage_json.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

bool shares_a_report(const TriagedSignature& a, const TriagedSignature& b) {
  return std::any_of(a.ids.begin(), a.ids.end(),
                     [&](const std::string& id) { return std::find(b.ids.begin(), b.ids.end(), id) != b.ids.end(); });
}

bool is_explained(const TriagedSignature& s) { return s.examined && s.cause.kind != CauseKind::unexplained; }

/// The same signature; or one of the same kind that has a report in common, or that differs in its cause alone where
/// one of the two causes is not known.
bool is_same(const TriagedSignature& a, const TriagedSignature& b) {
  if (a.id == b.id) return true;
  if (a.kind != b.kind) return false;
  if (shares_a_report(a, b) || differs_in_key_alone(a, b)) return true;
  const bool one_open = !is_explained(a) || !is_explained(b);
  return one_open && ((a.regions == b.regions && a.branches == b.branches) || !a.examined || !b.examined);
}

/// Whether the subject's answer to the case has a finding of this kind now; empty where it cannot be asked.
std::optional<bool> is_still_wrong(const Case& question, const FindingKind& kind, Workers& workers) {
  const Subject* subject = find_subject(kind.subject);
  const std::optional<Case> c = subject == nullptr ? std::nullopt : in_scalar(question, subject->scalar);
  if (!c || subject->offering(kind.query).answer == nullptr) return std::nullopt;
  const Finding f = confirmed(*c, workers.ask(*subject, *c), subject->standard_for(kind.query), Detail::full);
  return is_bad(f);
}

/// The case of the simplest report, and those of the others that can still be read.
std::vector<Case> cases_of(const TriagedSignature& s) {
  std::vector<Case> all{s.case_of_simplest};
  for (const std::string& file : s.reports) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) continue;
    try {
      all.push_back(read_case_or_report(file));
    } catch (const BadInput&) {  // the file has become another one; the simplest case is left
    }
  }
  return all;
}

/// A row of the baseline that has no signature now.
bool add_absent(const TriagedSignature& earlier, Triage& now, Workers& workers) {
  bool wrong = false;
  for (const Case& c : cases_of(earlier)) {
    const std::optional<bool> still = is_still_wrong(c, earlier.kind, workers);
    if (!still) return false;
    wrong = wrong || *still;
  }
  TriagedSignature s = earlier;
  s.change = wrong ? SignatureChange::known : SignatureChange::fixed;
  s.decision.reset();
  s.findings = 0;
  s.reports.clear(), s.ids.clear(), s.worst.clear();
  std::error_code error;
  if (!fs::is_regular_file(s.simplest, error)) s.simplest.clear();
  now.signatures.push_back(std::move(s));
  return true;
}

/// Rows, by kind, of the reports whose subject is right now.
void add_right_now(const Triage& t, std::vector<TriagedSignature>& rows) {
  for (const FiledReport& r : t.right_now) {
    const nlohmann::json j = parse_json(read_file(r.file), r.file.string());
    const FileValue report(j, r.file.string());
    TriagedSignature s;
    s.kind = kind_in_report(report);
    s.id = id_of(s);
    const auto same = std::find_if(rows.begin(), rows.end(), [&](const auto& o) { return o.id == s.id; });
    if (same != rows.end()) {
      same->reports.push_back(r.file.string());
      continue;
    }
    s.version = report.at("subject").at("version").text();
    s.headline = report.at("headline").text();
    s.cause.text = "It was not looked for: the subject is right now.";
    s.case_of_simplest = r.question;
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

std::vector<TriagedSignature> read_baseline(const std::string& name, const TriageSettings& settings, Workers& workers) {
  std::error_code error;
  fs::path file = name;
  if (fs::is_directory(name, error)) file = fs::path(name) / "triage" / "triage.json";
  if (fs::is_regular_file(file, error)) {
    std::vector<TriagedSignature> all = signatures_from_json(parse_json(read_file(file), file.string()), file.string());
    std::erase_if(all, [](const TriagedSignature& s) { return s.change == SignatureChange::fixed; });
    return all;
  }
  const Sources sources = read_sources({name});
  name_skipped(sources);
  Triage earlier = triage(sources, settings, workers);
  std::vector<TriagedSignature> rows = std::move(earlier.signatures);
  add_right_now(earlier, rows);
  return rows;
}

std::vector<std::string> compare_with(const std::vector<TriagedSignature>& baseline, Triage& now, Workers& workers) {
  std::set<std::string> cannot_be_asked;
  for (TriagedSignature& s : now.signatures) s.change = SignatureChange::fresh;
  const std::size_t here = now.signatures.size();
  for (const TriagedSignature& earlier : baseline) {
    bool found = false;
    for (std::size_t i = 0; i < here; ++i) {
      TriagedSignature& s = now.signatures[i];
      if (!is_same(s, earlier)) continue;
      found = true;
      const bool worse = earlier.size.relative > 0 && s.size.relative >= much_worse * earlier.size.relative;
      if (s.change != SignatureChange::known) s.change = worse ? SignatureChange::worse : SignatureChange::known;
    }
    if (!found && !add_absent(earlier, now, workers)) cannot_be_asked.insert(earlier.kind.subject);
  }
  rank(now.signatures);
  return {cannot_be_asked.begin(), cannot_be_asked.end()};
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
      if (s.id != d.id) continue;
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
