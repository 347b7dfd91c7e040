#include "reports/engine/run.hpp"

#include <fmt/chrono.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "corpus/codec.hpp"
#include "corpus/fit.hpp"
#include "reports/findings/explain.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/engine/replay.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;
using namespace std::chrono_literals;

/// An index is not written more often, and not for more than a share of the time.
constexpr auto between_indexes = 500ms;
constexpr int index_share = 30;
constexpr std::size_t least_batch = 32;
constexpr double most_seconds_per_batch = 0.4;
constexpr int run_schema_version = 2;

std::string utc_text(const char* format) { return fmt::format(fmt::runtime(format), fmt::gmtime(std::time(nullptr))); }

double seconds_since(Run::Clock::time_point t) { return std::chrono::duration<double>(Run::Clock::now() - t).count(); }

/// Turns the state of the index that is there from running to failed, byte for byte: this needs no room on the disk.
void mark_as_failed(const std::filesystem::path& index) noexcept {
  constexpr std::string_view running = "\"state\": \"running\",", failed = "\"state\": \"failed\" ,";
  static_assert(running.size() == failed.size());
  std::array<char, 256> head{};  // the state is the index's second member
  const int file = open(index.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return;
  const ssize_t got = pread(file, head.data(), head.size(), 0);
  const std::size_t at = std::string_view(head.data(), std::size_t(std::max<ssize_t>(0, got))).find(running);
  // Whether it succeeds is no matter: nothing else can be done, and the error that led here is told by others.
  if (at != std::string_view::npos) [[maybe_unused]] const auto put = pwrite(file, failed.data(), failed.size(), off_t(at));
  close(file);
}

/// One of them, for the summary.
std::string_view noun_of(Disagreement d) {
  switch (d) {
    case Disagreement::none: return "other violation";
    case Disagreement::off_surface: return "off-surface place";
    case Disagreement::wrong_time:
    case Disagreement::wrong_place:
    case Disagreement::wrong_normal:
    case Disagreement::wrong_depth:
    case Disagreement::wrong_direction:
    case Disagreement::wrong_weight:
    case Disagreement::wrong_flag:
    case Disagreement::wrong_index:
    case Disagreement::wrong_combination:
    case Disagreement::negative_time:
    case Disagreement::false_hit:
    case Disagreement::false_miss: return nearmiss::name_of(d);
    case Disagreement::not_finite: return "non-finite number";
    case Disagreement::not_unit: return "non-unit normal";
  }
  return "?";
}

std::string percent_text(std::uint64_t part, std::uint64_t whole) {
  if (part == 0 || whole == 0) return "0 %";
  const double percent = 100 * double(part) / double(whole);
  return percent >= 10 ? fmt::format("{:.0f} %", percent) : fmt::format("{:.2g} %", percent);
}

/// Violations by kind of disagreement: a false hit is never added to a false miss.
std::vector<std::string> table_row(const Tally& t) {
  const std::uint64_t hits = t.violations_by(Disagreement::false_hit), misses = t.violations_by(Disagreement::false_miss);
  return {"  " + t.subject->name,
          count_text(t.cases),
          count_text(t.of(Verdict::agrees)),
          count_text(t.of(Verdict::not_proved)),
          count_text(hits),
          count_text(misses),
          count_text(t.wrong),
          count_text(t.of(Verdict::broke)),
          count_text(t.of(Verdict::out_of_domain) + t.of(Verdict::not_asked)),
          count_text(t.of(Verdict::cannot_answer)),
          t.worst_backward < 0 ? "-" : "> " + epsilons_text(t.worst_backward),
          fmt::format("{:.3g}", t.worst_forward),
          percent_text(t.truth_yes, t.decided()),
          percent_text(t.decided_by_exact, t.decided())};
}

}  // namespace

std::string_view name_of(RunState s) {
  switch (s) {
    case RunState::running: return "running";
    case RunState::finished: return "finished";
    case RunState::interrupted: return "interrupted";
    default: return "failed";
  }
}

std::filesystem::path runs_folder() {
  if (const char* named = std::getenv("NEARMISS_RUNS"); named != nullptr && *named != '\0') return named;
  return NEARMISS_RUNS_FOLDER;
}

std::filesystem::path new_run_folder(std::uint64_t seed) {
  return runs_folder() / fmt::format("{}-{}", utc_text("{:%Y%m%dT%H%M%SZ}"), seed);
}

/// A finding whose report is written after its batch: a report asks other subjects, whose answers to
/// the batch may still be wanted.
struct Run::Pending {
  Case question;
  const Subject* subject;
  Answer answer;
  std::string output;  ///< of a subject that broke
};

struct Run::Notes {
  Json parts = Json::object();
};

Run::Run(RunSettings settings)
    : settings_(std::move(settings)),
      started_(utc_text("{:%Y-%m-%dT%H:%M:%SZ}")),
      begin_(Clock::now()),
      workers_([this] { return goes_on(); }),
      internal_errors_(settings_.folder),
      notes_(std::make_unique<Notes>()) {
  for (const Query* q : settings_.queries) {
    for (const Subject* s : settings_.subjects) {
      if (s->offering(q->name).answer != nullptr) tally(*q, *s) = {q, s};
    }
  }
  make_folder(settings_.folder);
  settle_runs_below(settings_.folder.has_parent_path() ? settings_.folder.parent_path() : ".");
  settle_run(settings_.folder);
  lock_.emplace(settings_.folder);
  written_ = reports_on_disk(settings_.folder);
  for (WrittenReport& w : written_) w.earlier = true;
  write_index(RunState::running);
}

Run::~Run() {
  if (finished_) return;
  try {
    write_index(RunState::failed);
  } catch (const std::exception&) {  // what made it fail is on its way already
    mark_as_failed(settings_.folder / "index.json");
  }
}

Tally& Run::tally(const Query& query, const Subject& subject) { return tallies_[{&query, &subject}]; }

std::vector<const Subject*> Run::asked(const Query& query, Scalar scalar) const {
  std::vector<const Subject*> asked;
  for (const Subject* s : settings_.subjects) {
    if (s->scalar == scalar && tallies_.contains({&query, s})) asked.push_back(s);
  }
  return asked;
}

bool Run::should_stop() const { return interrupted() || (settings_.until && Clock::now() >= *settings_.until); }

void Run::examine(std::span<const Case> cases, const std::function<void()>& meanwhile) {
  examine(asked(*cases.front().query, cases.front().scalar), cases, meanwhile);
}

/// Called while a subject is awaited. The reports of a run whose time is over get a moment.
bool Run::goes_on() {
  constexpr auto moment = 300ms;
  tick();
  return !interrupted() && !(settings_.until && Clock::now() >= *settings_.until + moment);
}

void Run::examine(const std::vector<const Subject*>& chosen, std::span<const Case> cases,
                  const std::function<void()>& meanwhile) {
  std::vector<const Subject*> asked_now;
  for (const Subject* s : chosen) {
    if (Tally& t = tally(*cases.front().query, *s); t.gives_up()) {
      t.gave_up += cases.size();
    } else {
      asked_now.push_back(s);
    }
  }
  for (const Subject* s : asked_now) workers_.send(*s, cases);
  if (meanwhile) meanwhile();
  std::vector<std::optional<bool>> touching(cases.size());
  for (const Subject* s : asked_now) {
    const std::span<const Answer> answers = workers_.receive(*s);
    if (answers.size() < cases.size() && !should_stop()) tally(*cases.front().query, *s).gave_up += cases.size() - answers.size();
    for (std::size_t i = 0; i < answers.size() && (i % 64 != 0 || !should_stop()); ++i) {
      const std::optional<Finding> f = take(cases[i], *s, answers[i], workers_.output(*s, i));
      if (f) touches_.count(cases[i], *s, answers[i], *f, touching[i]);
    }
  }
  write_pending();
  tick();
}

void Run::examine_by_all(const Case& question, const std::function<void(const Subject&, const Finding&)>& each) {
  for (const Subject* s : settings_.subjects) {
    if (!tallies_.contains({question.query, s})) continue;
    if (Tally& t = tally(*question.query, *s); t.gives_up()) {
      ++t.gave_up;
      continue;
    }
    std::optional<Finding> f;
    if (const std::optional<Case> same = in_scalar(question, s->scalar)) {
      const Answer answer = workers_.ask(*s, *same);
      f = take(*same, *s, answer, workers_.output(*s, 0));
    } else {
      f.emplace().verdict = Verdict::out_of_domain;
      count(question, *s, {}, *f, {});
    }
    if (each && f) each(*s, *f);
  }
  write_pending();
  tick();
}

std::optional<Finding> Run::take(const Case& question, const Subject& subject, const Answer& answer, std::string_view output) {
  const Standard standard = subject.standard_for(question.query->name);
  const auto f = internal_errors_.judged(question, subject, answer, standard, Detail::verdict);
  if (f) count(question, subject, answer, *f, output);
  return f;
}

void Run::count(const Case& question, const Subject& subject, const Answer& answer, const Finding& f,
                std::string_view output) {
  Tally& t = tally(*question.query, subject);
  t.count(f);
  t.late += answer.late;
  ++cases_;
  if (settings_.by_class) {
    if (question.moves.empty()) by_class_[{&subject, "none"}].count(f);
    for (const auto& move : question.moves) by_class_[{&subject, std::string(move)}].count(f);
  }
  if (!is_bad(f)) return;
  ++bad_;
  if (keeper_.keep(t, f)) pending_.push_back({question, &subject, answer, std::string(output)});
}

void Run::write_pending() {
  for (const Pending& p : pending_) write_report(p);
  pending_.clear();
}

void Run::write_report(const Pending& p) {
  Report r = nearmiss::examine(p.question, *p.subject, p.answer, workers_);
  r.output = p.output;
  const std::string name = fmt::format("{}-{}-{}.json", r.subject, fault_of(r.finding), id_of(r));
  const std::filesystem::path below = std::filesystem::path("findings") / r.question.query->name / name;
  r.replay = replay_command(*p.subject, (settings_.folder / below).string());
  write(below, pretty_json(report_to_json(r)));
  std::erase_if(written_, [&](const WrittenReport& w) { return w.earlier && w.file == below.generic_string(); });
  written_.push_back({below.generic_string(), id_of(r), std::string(r.question.query->name), r.subject,
                      std::string(nearmiss::name_of(r.finding.verdict)),
                      std::string(nearmiss::name_of(r.finding.disagreement)), headline(r),
                      r.finding.verdict == Verdict::broke ? tally(*r.question.query, *p.subject).breakage_of(r.finding) : "",
                      r.finding.backward ? std::optional(r.finding.backward->above) : std::nullopt});
}

void Run::generate(std::optional<std::uint64_t> cases) {
  struct Stream {
    const Query* query;
    Scalar scalar;
    Preconditions required;                ///< of all its subjects
    std::vector<const Subject*> subjects;
    std::uint64_t next = 0;
    double seconds = 0;
    std::size_t batch = least_batch;  ///< cases to ask at once, as many as keep the run answering to a user who stops it
  };
  std::vector<Stream> streams;
  std::uint64_t total = cases_;
  for (const Query* q : settings_.queries) {
    for (const Scalar scalar : {Scalar::float32, Scalar::float64}) {
      std::map<Preconditions, std::vector<const Subject*>> sets;
      for (const Subject* s : asked(*q, scalar)) sets[s->offering(q->name).required].push_back(s);
      for (const auto& [required, alike] : sets) {
        streams.push_back({q, scalar, required, alike});
        total += alike.size() * cases.value_or(0);
      }
    }
  }
  if (cases) total_ = total;
  struct Batch {
    Stream* of = nullptr;  ///< nullptr: no cases are left
    std::vector<Case> cases;
    double seconds = 0;  ///< that making it took
  };
  const auto make = [&](Batch& batch) {
    const Clock::time_point begin = Clock::now();
    const auto left = [&](const Stream& s) { return cases ? *cases - s.next : std::uint64_t{s.batch}; };
    const auto behind = [&](const Stream& a, const Stream& b) {
      return std::pair(left(a) == 0, a.seconds) < std::pair(left(b) == 0, b.seconds);
    };
    const auto stream = std::min_element(streams.begin(), streams.end(), behind);
    batch.of = stream == streams.end() || left(*stream) == 0 ? nullptr : &*stream;
    if (batch.of == nullptr) return;
    batch.cases.resize(std::min({stream->batch, std::size_t(left(*stream)), Workers::capacity_for(*stream->query)}));
    for (Case& c : batch.cases) {
      generate_inside(c, *stream->query, stream->scalar, settings_.seed, stream->next++, stream->required);
    }
    batch.seconds = seconds_since(begin);
    stream->seconds += batch.seconds;
  };
  Batch now, next;
  for (make(now); now.of != nullptr && !should_stop(); std::swap(now, next)) {
    const Clock::time_point begin = Clock::now();
    examine(now.of->subjects, now.cases, [&] { make(next); });  // the subjects' processes answer meanwhile
    const double seconds = seconds_since(begin) - next.seconds;
    now.of->seconds += seconds;
    if (seconds < most_seconds_per_batch / 4) now.of->batch = std::min(2 * now.of->batch, Workers::batch);
    if (seconds > most_seconds_per_batch) now.of->batch = std::max(now.of->batch / 2, least_batch);
  }
}

void Run::note(const std::string& part, Json value) { notes_->parts[part] = std::move(value); }

void Run::doing(std::string what) { progress_.doing(std::move(what)); }

void Run::tick() {
  std::optional<double> left;
  if (settings_.until) left = std::chrono::duration<double>(*settings_.until - Clock::now()).count();
  progress_.tell(cases_, total_, left, bad_);
  const auto since = Clock::now() - indexed_;
  if (since >= between_indexes && since >= index_share * indexing_) write_index(RunState::running);
}

void Run::write_index(RunState state) {
  const Clock::time_point begin = Clock::now();
  Json j{{"schema", run_schema_version},
         {"state", name_of(state)},
         {"summary", summary()},
         {"command", settings_.command},
         {"seed", settings_.seed},
         {"started", started_},
         {"updated", utc_text("{:%Y-%m-%dT%H:%M:%SZ}")},
         {"seconds", seconds_since(begin_)},
         {"cases", cases_},
         {"findings", bad()}};
  j["tallies"] = Json::array();
  for (const Query* q : settings_.queries) {
    for (const Subject* s : settings_.subjects) {
      if (const auto t = tallies_.find({q, s}); t != tallies_.end()) j["tallies"].push_back(tally_to_json(t->second));
    }
  }
  j["stages"] = Json::array();
  for (const Query* q : settings_.queries) {
    const Stages stages = stages_of(*q);
    j["stages"].push_back({{"query", q->name}, {"interval", stages.interval}, {"exact", stages.exact}});
  }
  j["not_offered"] = Json::array();
  for (const Query* q : settings_.queries) {
    for (const Subject* s : settings_.subjects) {
      if (!tallies_.contains({q, s})) {
        j["not_offered"].push_back({{"query", q->name}, {"subject", s->name}, {"why", s->offering(q->name).how}});
      }
    }
  }
  if (settings_.by_class) j["by_class"] = Json::array();
  for (const auto& [key, t] : by_class_) {
    const std::uint64_t hits = t.violations_by(Disagreement::false_hit);
    const std::uint64_t misses = t.violations_by(Disagreement::false_miss);
    j["by_class"].push_back({{"subject", key.first->name},
                             {"class", key.second},
                             {"cases", t.cases},
                             {"false_hits", hits},
                             {"false_misses", misses},
                             {"wrong", t.wrong},
                             {"broke", t.of(Verdict::broke)}});
  }
  j["touches"] = touches_.to_json();
  j["inconsistent_conventions"] = Json::array();
  for (const Touches::Inconsistent& i : touches_.inconsistent()) {
    j["inconsistent_conventions"].push_back({{"subject", i.subject->name}, {"closed", i.closed}, {"strict", i.strict}});
  }
  if (internal_errors_.count() > 0) j["internal_errors"] = internal_errors_.to_json();
  j.update(notes_->parts);
  j["reports"] = Json::array();
  for (const WrittenReport& w : written_) j["reports"].push_back(written_to_json(w));
  j["environment"] = environment_to_json();
  write("index.json", pretty_json(j));
  indexed_ = Clock::now();
  indexing_ = indexed_ - begin;
}

void Run::write(const std::filesystem::path& below, const std::string& text) const {
  try {
    make_folder((settings_.folder / below).parent_path());
    write_file(settings_.folder / below, text);
  } catch (const BadInput& e) {
    if (cases_ == 0) throw;
    throw BadInput(fmt::format("{}; the run ends after {}, {}", e.what(), plural_text(cases_, "answer"), violated_text()));
  }
}

void Run::finish() {
  write_index(interrupted() ? RunState::interrupted : RunState::finished);
  finished_ = true;
}

std::optional<std::string> Run::shortfall() const {
  const std::string index = (settings_.folder / "index.json").string();
  if (interrupted()) {
    return fmt::format("interrupted after {}, {}; {}", plural_text(cases_, "answer"), violated_text(), index);
  }
  if (cases_ > 0) return std::nullopt;
  return fmt::format("nothing was asked: the time was over before the first case; {}", index);
}

std::uint64_t Run::bad() const { return bad_ + touches_.inconsistent().size(); }
std::uint64_t Run::cases() const { return cases_; }
int Run::exit_code() const {
  if (internal_errors_.count() > 0) return InternalError::exit_code;
  return bad() > 0 ? 1 : shortfall() ? 2 : 0;
}

/// "nothing violated", or all that was by kind; and how many queries had no turn.
std::string Run::violated_text() const {
  if (cases_ == 0) return "nothing asked";
  std::map<std::string_view, std::uint64_t> faults;
  std::set<std::string> reasons;
  for (const auto& [key, t] : tallies_) {
    for (const auto& [kind, count] : t.breakages) reasons.insert(kind);
    for (int d = 0; d < disagreement_count; ++d) faults[noun_of(Disagreement(d))] += t.violations[std::size_t(d)];
    faults["breakage"] += t.of(Verdict::broke);
  }
  faults["inconsistent convention"] += touches_.inconsistent().size();
  std::vector<std::string> counted;
  for (const auto& [fault, count] : faults) {
    if (count == 0) continue;
    counted.push_back(plural_text(count, fault));
    if (fault == "breakage" && reasons.size() > 1) counted.back() += fmt::format(" of {} kinds", reasons.size());
  }
  std::map<const Query*, std::uint64_t> asked;
  std::uint64_t not_asked = 0;
  for (const auto& [key, t] : tallies_) asked[key.first] += t.cases, not_asked += t.of(Verdict::not_asked);
  const auto unasked = std::uint64_t(std::count_if(asked.begin(), asked.end(), [](const auto& a) { return a.second == 0; }));
  return (counted.empty() ? "nothing violated" : "violations: " + list_text(counted)) +
         (not_asked == 0 ? "" : fmt::format(", {} not asked for what subjects require", plural_text(not_asked, "case"))) +
         (unasked == 0 ? "" : fmt::format(", {} of {} queries not asked", unasked, asked.size()));
}

std::string Run::summary() const {
  const double seconds = seconds_since(begin_);
  return fmt::format("{}{} in {} ({}/s): {}; {} in {}{}", interrupted() ? "interrupted: " : "",
                     plural_text(cases_, "answer"), duration_text(seconds),
                     count_text(std::uint64_t(double(cases_) / std::max(seconds, 1e-3))), violated_text(),
                     plural_text(reports(), "report"), settings_.folder.string(), internal_errors_.text());
}

/// Those of this run.
std::size_t Run::reports() const {
  return std::size_t(std::count_if(written_.begin(), written_.end(), [](const WrittenReport& w) { return !w.earlier; }));
}

std::string Run::worst_findings() const {
  constexpr std::size_t shown = 12;
  std::vector<const WrittenReport*> worst;
  for (const WrittenReport& w : written_) {
    if (w.earlier) continue;
    const auto same = std::find_if(worst.begin(), worst.end(), [&](const WrittenReport* o) {
      return std::tie(o->query, o->subject, o->verdict, o->disagreement, o->breakage) ==
             std::tie(w.query, w.subject, w.verdict, w.disagreement, w.breakage);
    });
    if (same == worst.end()) {
      worst.push_back(&w);
    } else if (w.above > (*same)->above) {
      *same = &w;
    }
  }
  std::stable_sort(worst.begin(), worst.end(), [](auto a, auto b) { return a->above > b->above; });
  std::string text;
  for (std::size_t i = 0; i < worst.size() && i < shown; ++i) {
    text += fmt::format("{}\n    {}\n", worst[i]->headline, (settings_.folder / worst[i]->file).string());
  }
  if (worst.size() > shown) text += fmt::format("and {} more, see index.json\n", worst.size() - shown);
  return text.empty() ? text : text + "\n";
}

std::string Run::table() const {
  if (cases_ == 0) return "";
  std::vector<std::vector<std::string>> rows{{"", "CASES", "AGREE", "NOT PROVED", "FALSE HIT", "FALSE MISS", "WRONG",
                                              "BROKE", "OUTSIDE", "NO ANSWER", "BACKWARD", "FORWARD", "YES", "EXACT"}};
  for (const Query* q : settings_.queries) {
    bool first = true;
    for (const Subject* s : settings_.subjects) {
      const auto found = tallies_.find({q, s});
      if (found == tallies_.end()) continue;
      if (std::exchange(first, false)) rows.push_back({std::string(q->name)});
      rows.push_back(table_row(found->second));
    }
  }
  if (settings_.queries.size() > 1) rows.push_back({"all queries"});
  for (const Subject* s : settings_.subjects) {
    Tally all{nullptr, s};
    for (const auto& [key, t] : tallies_) {
      if (key.second == s) all.add(t);
    }
    if (settings_.queries.size() > 1 && all.cases > 0) rows.push_back(table_row(all));
  }
  return table_text(rows, "", 1) + breakages_text() + given_up_text() + stages_text();
}

/// Who was not asked any more; empty where all were asked to the end.
std::string Run::given_up_text() const {
  std::string text;
  for (const auto& [key, t] : tallies_) {
    if (t.gave_up == 0) continue;
    text += fmt::format("\n{}", nearmiss::given_up_text(t.subject->name, t.query->name, t.late, t.gave_up));
  }
  return text.empty() ? text : text + "\n";
}

/// Why subjects broke, most often first; empty where none did.
std::string Run::breakages_text() const {
  struct Row {
    std::uint64_t count;
    std::string subject, query, kind;
  };
  std::vector<Row> all;
  for (const auto& [key, t] : tallies_) {
    for (const auto& [kind, count] : t.breakages) {
      all.push_back({count, key.second->name, std::string(key.first->name), kind});
    }
  }
  if (all.empty()) return "";
  std::sort(all.begin(), all.end(), [](const Row& a, const Row& b) {
    return std::tie(b.count, a.subject, a.query, a.kind) < std::tie(a.count, b.subject, b.query, b.kind);
  });
  std::vector<std::vector<std::string>> rows{{"BROKE", "SUBJECT", "QUERY", "REASON"}};
  for (const Row& r : all) rows.push_back({count_text(r.count), r.subject, r.query, r.kind});
  return fmt::format("\n{}", table_text(rows));
}

Run::Stages Run::stages_of(const Query& query) const {
  Stages stages;
  for (const Subject* s : settings_.subjects) {
    const auto found = tallies_.find({&query, s});
    if (found == tallies_.end()) continue;
    stages.interval += found->second.decided_by_interval;
    stages.exact += found->second.decided_by_exact;
  }
  return stages;
}

std::string Run::stages_text() const {
  Stages all;
  const Query* most = nullptr;
  for (const Query* q : settings_.queries) {
    const Stages stages = stages_of(*q);
    all.interval += stages.interval;
    all.exact += stages.exact;
    if (most == nullptr || stages.exact_share() > stages_of(*most).exact_share()) most = q;
  }
  if (all.interval + all.exact == 0) return "";
  if (all.exact == 0) return "\nIntervals decided every case.\n";
  return fmt::format("\nThe exact stage decided {}, most often of {}: {}; intervals decided the others.\n",
                     percent_text(all.exact, all.interval + all.exact), most->name,
                     percent_text(stages_of(*most).exact, stages_of(*most).interval + stages_of(*most).exact));
}

std::string Run::touches_text() const {
  std::string text = touches_.text();
  for (const Touches::Inconsistent& i : touches_.inconsistent()) {
    text += fmt::format("{} has an inconsistent convention: exact touches are contact in {}, and none in {}\n",
                        i.subject->name, list_text(i.closed), list_text(i.strict));
  }
  return text.empty() ? text : text + "\n";
}

std::string Run::table_by_class() const {
  std::vector<std::vector<std::string>> rows{{"", "CASES", "FALSE HIT", "FALSE MISS", "WRONG", "BROKE"}};
  for (const Subject* s : settings_.subjects) {
    bool first = true;
    for (const auto& [key, t] : by_class_) {
      if (key.first != s) continue;
      if (std::exchange(first, false)) rows.push_back({s->name});
      const std::uint64_t hits = t.violations_by(Disagreement::false_hit);
      const std::uint64_t misses = t.violations_by(Disagreement::false_miss);
      rows.push_back({"  " + key.second, count_text(t.cases), count_text(hits), count_text(misses),
                      count_text(t.wrong), count_text(t.of(Verdict::broke))});
    }
  }
  return table_text(rows, "", 1);
}

}  // namespace nearmiss
