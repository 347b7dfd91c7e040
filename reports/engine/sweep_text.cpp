/// The state of a sweep as JSON, and its result as text.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "corpus/files/errors.hpp"
#include "corpus/files/file_value.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/sweep.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

constexpr int sweep_schema_version = 1;

const char* word_of(SliceTruth t) { return t == SliceTruth::yes ? "yes" : t == SliceTruth::no ? "no" : "invalid"; }

SliceTruth truth_from(const FileValue& word) {
  for (const SliceTruth t : {SliceTruth::yes, SliceTruth::no, SliceTruth::invalid}) {
    if (word.json() == word_of(t)) return t;
  }
  word.fail("\"yes\", \"no\" or \"invalid\"");
}

/// A position of a float, at least `least` and at most `most`.
std::uint64_t position_in(const FileValue& j, std::uint64_t least, std::uint64_t most) {
  if (!j.json().is_number_unsigned() || j.whole() < least || j.whole() > most)
    j.fail(fmt::format("a whole number from {} to {}", least, most));
  return j.whole();
}

std::string word_of_part(const std::string& part) {
  if (part == "inputs") return "case";
  if (part == "begin" || part == "end") return "range of floats";
  if (part == "subjects") return "list of subjects";
  return part == "environment" ? "build" : part;
}

std::string float_text(std::uint64_t at) {
  const float x = float_at(at);
  return x == 0 && std::signbit(x) ? "-0" : number_text(double(x), Scalar::float32);
}

Json range_to_json(const SweptRange& r) {
  Json truth = Json::array();
  for (const TruthRange& t : r.truth) truth.push_back({{"begin", t.begin}, {"decision", word_of(t.truth)}});
  return {{"begin", r.begin}, {"end", r.end}, {"truth", truth}};
}

/// A range that is not empty and lies in the floats from `begin` up to, without, `end`.
SweptRange range_from_json(const FileValue& j, std::uint64_t begin, std::uint64_t end) {
  SweptRange r{position_in(j.at("begin"), begin, end - 1), 0, {}};
  r.end = position_in(j.at("end"), r.begin + 1, end);
  std::uint64_t least = r.begin, most = r.begin;
  for (const FileValue& t : j.at("truth").items()) {
    r.truth.push_back({position_in(t.at("begin"), least, most), truth_from(t.at("decision"))});
    least = r.truth.back().begin + 1, most = r.end - 1;
  }
  if (r.truth.empty()) j.at("truth").fail("the decisions of the range");
  return r;
}

/// Whether both have the same members, each with the same number to the last bit.
bool is_same_json(const nlohmann::json& a, const Json& b) { return a.dump() == nlohmann::json(b).dump(); }

}  // namespace

/// What must be equal in a state for the sweep to go on from it.
Json Sweep::identity() const {
  const Slice& slice = settings_.slice;
  Json subjects = Json::array();
  for (const Subject& s : settings_.subjects) subjects.push_back({{"name", s.name}, {"version", s.version}});
  Json question = case_to_json(slice.question());
  return {{"query", slice.query().name},
          {"number", slice.field().name},
          {"inputs", question.at("inputs")},
          {"begin", settings_.begin},
          {"end", settings_.end},
          {"subjects", subjects},
          {"environment", environment_to_json()}};
}

void Sweep::load() {
  const std::string file = (settings_.folder / "sweep.json").string();
  const nlohmann::json j = parse_json(read_file(file), file);
  if (!j.is_object() || !j.contains("schema") || j["schema"] != sweep_schema_version || !j.contains("identity"))
    throw BadInput(fmt::format("{}: it is not the state of a sweep; give another --out", file));
  const FileValue state(j, file);
  check_identity(state);
  std::uint64_t from = settings_.begin;
  for (const FileValue& r : state.at("done").items()) {
    if (from == settings_.end) r.fail("absent: the floats up to the last one are done");
    done_.push_back(range_from_json(r, from, settings_.end));
    from = done_.back().end;
  }
  load_counts(state.at("subjects"));
  seconds_before_ = state.at("seconds").not_negative();
  check_truth(file);
}

void Sweep::check_identity(const FileValue& state) const {
  const FileValue theirs = state.at("identity");
  const Json mine = identity();
  for (const auto& [part, value] : mine.items()) {
    const std::optional<FileValue> other = theirs.find(part);
    if (other && is_same_json(other->json(), value)) continue;
    throw BadInput(fmt::format("{}: it is the state of another sweep: the {} differs; give another --out", state.file(),
                               word_of_part(part)));
  }
}

void Sweep::load_counts(const FileValue& subjects) {
  const std::vector<FileValue> all = subjects.items();
  if (all.size() != counts_.size()) subjects.fail(fmt::format("an array of {}", counts_.size()));
  const std::uint64_t valid = floats_done(true);
  for (std::size_t s = 0; s < counts_.size(); ++s) {
    counts_[s] = sweep_counts_from_json(all[s]);
    if (all[s].at("subject").text() != settings_.subjects[s].name)
      all[s].at("subject").fail(settings_.subjects[s].name);
    if (counts_[s].asked != valid)
      all[s].at("asked").fail(fmt::format("{}, the number of valid floats in done", valid));
    for (const char* of : {"first_violation", "worst_violation"}) {
      const FileValue violation = all[s].at(of);
      if (violation.is_null()) continue;
      const std::uint64_t at = violation.at("position").whole();
      if (!is_done(at)) violation.at("position").fail("the position of a float that is done");
    }
    if (counts_[s].first.has_value() != counts_[s].worst.has_value())
      all[s].at("worst_violation").fail("null where first_violation is null");
  }
}

bool Sweep::is_done(std::uint64_t position) const {
  return std::any_of(done_.begin(), done_.end(),
                     [&](const SweptRange& r) { return r.begin <= position && position < r.end; });
}

/// Finds the exact decisions of the ranges again, which takes a small part of the time of a sweep.
void Sweep::check_truth(const std::string& file) const {
  for (const SweptRange& r : done_) {
    const std::vector<TruthRange> truth = settings_.slice.truth(r.begin, r.end, [] { return interrupted(); });
    if (interrupted()) throw BadInput(fmt::format("{}: interrupted before its decisions were checked", file));
    if (truth == r.truth) continue;
    throw BadInput(fmt::format("{}: its decisions are not the exact ones; give another --out", file));
  }
}

/// Where the decision changes, by numbers.
Json Sweep::truth_to_json() const {
  Json all = Json::array();
  for (const SweptRange& r : done_) {
    for (std::size_t i = 0; i < r.truth.size(); ++i) {
      const std::uint64_t end = i + 1 < r.truth.size() ? r.truth[i + 1].begin : r.end;
      all.push_back({{"from", double(float_at(r.truth[i].begin))},
                     {"to", double(float_at(end - 1))},
                     {"floats", end - r.truth[i].begin},
                     {"decision", word_of(r.truth[i].truth)}});
    }
  }
  return all;
}

Json Sweep::to_json() const {
  const bool complete = is_complete();
  Json j{{"schema", sweep_schema_version},
         {"state", complete     ? "finished"
                   : stopping() ? "interrupted"
                                : "running"},
         {"coverage", is_exhaustive() ? "exhaustive" : "partial"},
         {"command", settings_.command},
         {"identity", identity()},
         {"case", case_to_json(settings_.slice.question())},
         {"from", double(float_at(settings_.begin))},
         {"to", double(float_at(settings_.end - 1))},
         {"floats", settings_.end - settings_.begin},
         {"valid", floats_done(true)},
         {"invalid", floats_done(false)},
         {"jobs", settings_.jobs},
         {"seconds", seconds()},
         {"truth", truth_to_json()},
         {"subjects", Json::array()},
         {"done", Json::array()},
         {"reports", Json::array()}};
  for (std::size_t s = 0; s < counts_.size(); ++s) {
    Json of{{"subject", settings_.subjects[s].name}};
    of.update(sweep_counts_to_json(counts_[s]));
    j["subjects"].push_back(std::move(of));
  }
  for (const SweptRange& r : done_) j["done"].push_back(range_to_json(r));
  for (const WrittenReport& w : reports_) j["reports"].push_back(written_to_json(w));
  if (internal_errors_.count() > 0) j["internal_errors"] = internal_errors_.to_json();
  return j;
}

std::string Sweep::coverage_text() const {
  if (is_exhaustive()) return "exhaustive";
  const std::string range =
      fmt::format("partial: {} to {}", float_text(settings_.begin), float_text(settings_.end - 1));
  return is_complete() ? range : range + ", not complete";
}

std::vector<std::string> Sweep::table_row(std::size_t subject) const {
  const SweepCounts& c = counts_[subject];
  const double asking = c.seconds - c.judge_seconds;
  return {settings_.subjects[subject].name,
          count_text(c.asked),
          count_text(c.false_hits),
          count_text(c.false_misses),
          count_text(c.not_finite),
          count_text(c.negative_times),
          count_text(c.broke),
          count_text(c.outside),
          count_text(c.violations),
          c.worst_backward < 0 ? "-" : "> " + epsilons_text(c.worst_backward),
          c.asked == 0 ? "-" : fmt::format("{:.1f}", asking / double(c.asked) * 1e9)};
}

std::string Sweep::table() const {
  std::vector<std::vector<std::string>> rows{{"", "FLOATS", "FALSE HIT", "FALSE MISS", "NOT FINITE", "NEGATIVE TIME",
                                              "BROKE", "OUTSIDE", "VIOLATIONS", "BACKWARD", "NS/FLOAT"}};
  for (std::size_t s = 0; s < counts_.size(); ++s) rows.push_back(table_row(s));
  return table_text(rows, "", 1);
}

std::string Sweep::sentence(std::size_t subject) const {
  const SweepCounts& c = counts_[subject];
  std::vector<std::string> faults;
  const auto name = [&](std::uint64_t n, const char* noun) {
    if (n > 0) faults.push_back(plural_text(n, noun));
  };
  name(c.false_hits, "false hit");
  name(c.false_misses, "false miss");
  name(c.not_finite, "non-finite answer");
  name(c.negative_times, "negative time");
  name(c.no_answer, "missing answer");
  name(c.broke, "breakage");
  std::string result = faults.empty() ? "every decision is exact" : list_text(faults);
  if (!faults.empty()) {
    result += c.bad() > 0             ? fmt::format(", {}", plural_text(c.violations, "violation"))
              : c.outside == c.judged ? ", all outside the domain of its contract"
                                      : ", no violation of its contract";
  }
  return fmt::format("{}, {} through all {} valid floats{}: {}: {} ({})", settings_.slice.query().name,
                     settings_.slice.field().name, count_text(c.asked),
                     is_exhaustive() ? ""
                     : is_complete() ? " of a range"
                                     : " so far",
                     settings_.subjects[subject].name, result, coverage_text());
}

std::string Sweep::changes_text() const {
  std::vector<std::string> changes;
  for (const SweptRange& r : done_) {
    for (std::size_t i = 1; i < r.truth.size(); ++i) {
      if (r.truth[i].truth == SliceTruth::invalid || r.truth[i - 1].truth == SliceTruth::invalid) continue;
      changes.push_back(fmt::format("{} from {} on", word_of(r.truth[i].truth), float_text(r.truth[i].begin)));
    }
  }
  return changes.empty() ? "The exact decision does not change."
                         : "The exact decision changes: " + list_text(changes) + ".";
}

std::string Sweep::summary() const {
  std::string text = changes_text() + "\n";
  for (std::size_t s = 0; s < counts_.size(); ++s) text += sentence(s) + "\n";
  return fmt::format("{}{} invalid floats, {} for {}; {}{}", text, count_text(floats_done(false)),
                     duration_text(seconds()), plural_text(counts_.size(), "subject"),
                     path_text(settings_.folder / "sweep.json"), internal_errors_.text());
}

std::optional<std::string> Sweep::shortfall() const {
  if (is_complete()) return std::nullopt;
  const std::uint64_t done = floats_done(true) + floats_done(false), all = settings_.end - settings_.begin;
  return fmt::format("interrupted after {} of {} floats; the same command with --out {} goes on from there",
                     count_text(done), count_text(all), shell_quoted(settings_.folder.string()));
}

}  // namespace nearmiss
