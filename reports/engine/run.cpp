#include "reports/engine/run.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
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

#include "corpus/files/source_folder.hpp"
#include "corpus/generator/fit.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/replay.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/report_text.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;
using namespace std::chrono_literals;

/// The least time between two writes of the index, and the bound on their share of the time: 1 / index_share.
constexpr auto between_indexes = 500ms;
constexpr int index_share = 30;

std::string utc_text(const char* format) { return fmt::format(fmt::runtime(format), fmt::gmtime(std::time(nullptr))); }

/// Overwrites the state "running" in the existing index with "failed", in place: this needs no space on the disk.
void mark_as_failed(const std::filesystem::path& index) noexcept {
  constexpr std::string_view running = "\"state\": \"running\",", failed = "\"state\": \"failed\" ,";
  static_assert(running.size() == failed.size());
  std::array<char, 256> head{};  // the state is the index's second member
  const int file = open(index.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return;
  const ssize_t got = pread(file, head.data(), head.size(), 0);
  const std::size_t at = std::string_view(head.data(), std::size_t(std::max<ssize_t>(0, got))).find(running);
  // A failure is ignored: nothing else can be done, and the caller reports the original error.
  if (at != std::string_view::npos) [[maybe_unused]]
    const auto put = pwrite(file, failed.data(), failed.size(), off_t(at));
  close(file);
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
  return source_folder() + "/reports/runs";
}

std::filesystem::path new_run_folder(std::uint64_t seed) {
  return runs_folder() / fmt::format("{}-{}", utc_text("{:%Y%m%dT%H%M%SZ}"), seed);
}

struct Run::Notes {
  Json parts = Json::object();
};

Run::Run(RunSettings settings)
    : settings_(std::move(settings)),
      started_(utc_text("{:%Y-%m-%dT%H:%M:%SZ}")),
      begin_(Clock::now()),
      notes_(std::make_unique<Notes>()),
      counts_(settings_.queries, settings_.subjects, settings_.by_class),
      kept_(settings_.folder, counts_, [this](const auto& below, const std::string& text) { write(below, text); }),
      campaign_({.folder = settings_.folder, .tick = [this] { tick(); }, .every_answer = settings_.every_answer},
                {&counts_, &kept_, &listener_}) {
  campaign_.set_until(settings_.until);
  kept_.ask_with(campaign_.dispatcher().workers());
  make_folder(settings_.folder);
  settle_runs_below(settings_.folder.has_parent_path() ? settings_.folder.parent_path() : ".");
  settle_run(settings_.folder);
  lock_.emplace(settings_.folder);
  kept_.list_those_on_disk();
  write_index(RunState::running);
}

Run::~Run() {
  if (finished_) return;
  try {
    write_index(RunState::failed);
  } catch (const std::exception&) {  // the original error is already being thrown
    mark_as_failed(settings_.folder / "index.json");
  }
}

void Run::extend(std::vector<const Subject*> subjects) {
  settings_.subjects = subjects;
  counts_.extend(std::move(subjects));
}

std::vector<const Subject*> Run::offering(const Query& query, std::span<const Subject* const> subjects) const {
  std::vector<const Subject*> all;
  for (const Subject* s : subjects) {
    if (counts_.of(query, *s) != nullptr) all.push_back(s);
  }
  return all;
}

void Run::examine(std::span<const Case> cases) {
  std::vector<const Subject*> subjects = offering(*cases.front().query, settings_.subjects);
  std::erase_if(subjects, [&](const Subject* s) { return s->scalar != cases.front().scalar; });
  campaign_.examine(subjects, cases);
}

void Run::examine_by(std::span<const Subject* const> subjects, const Case& question, Sink* listener) {
  listener_.to = listener;
  campaign_.examine_in_any_scalar(offering(*question.query, subjects), question);
  listener_.to = nullptr;
}

void Run::generate(std::optional<std::uint64_t> cases) {
  constexpr std::size_t first_batch = 32;
  Schedule schedule(settings_.queries, settings_.subjects, cases, first_batch, settings_.scene);
  if (cases) {
    total_ = counts_.cases();
    for (const Stream& s : schedule.streams()) *total_ += s.subjects.size() * *s.cases;
  }
  campaign_.generate(schedule, settings_.seed);
}

void Run::ask_worst_cases() {
  if (measure().for_all) return;
  set_activity("worst cases");
  for (const Query* q : settings_.queries) {
    for (const WorstCase& w : worst_cases(*q)) {
      if (should_stop()) return;
      const std::vector<const Subject*> all = offering(*q, settings_.subjects);
      const auto subject = std::find_if(all.begin(), all.end(), [&](const Subject* s) {
        return s->name == w.subject && s->scalar == w.question.scalar;
      });
      if (subject != all.end()) campaign_.examine_searched({&*subject, 1}, {&w.question, 1}, Detail::verdict);
    }
  }
  set_activity("");
}

/// Writes the climb's worst case if it is worse than the written one.
void Run::write_record(const Climb& c, std::map<const Climb*, double>& written) const {
  if (!c.record() || c.record()->error <= written[&c]) return;
  written[&c] = c.record()->error;
  const std::string name = fmt::format("{}-{}.json", c.subject().name, name_of(c.kind()));
  write(std::filesystem::path("worst") / c.query().name / name, pretty_json(worst_case_to_json(*c.record())));
}

void Run::climb(Climber& climber) {
  total_.reset();
  listener_.to = &climber;
  std::map<const Climb*, double> written;
  std::map<const Climb*, std::uint64_t> hills;
  Clock::time_point noted{};
  climber.run(campaign_, [&](const Climb& c) {
    set_activity(fmt::format("climbing, {}, {}", c.query().name, c.subject().name));
    if (std::exchange(hills[&c], c.hills()) != c.hills()) write_record(c, written);
    if (Clock::now() - noted < between_indexes) return;
    note("climbs", climber.to_json());
    noted = Clock::now();
  });
  listener_.to = nullptr;
  for (const Climb& c : climber.climbs()) write_record(c, written);
  note("climbs", climber.to_json());
}

void Run::note(const std::string& part, Json value) { notes_->parts[part] = std::move(value); }

void Run::set_activity(std::string what) { progress_.set_activity(std::move(what)); }

void Run::tick() {
  std::optional<double> left;
  if (campaign_.until()) left = std::chrono::duration<double>(*campaign_.until() - Clock::now()).count();
  progress_.show(counts_.cases() + counts_.not_judged(), total_, left, counts_.bad_answers());
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
         {"seconds", Campaign::seconds_since(begin_)},
         {"cases", counts_.cases()},
         {"findings", counts_.bad()}};
  counts_.add_to(j);
  j["variants"] = kept_.variants().to_json();
  if (internal_errors().count() > 0) j["internal_errors"] = internal_errors().to_json();
  j.update(notes_->parts);
  j["reports"] = Json::array();
  for (const WrittenReport& w : kept_.written()) j["reports"].push_back(written_to_json(w));
  if (!vanished_.empty()) j["vanished"] = vanished_;
  j["environment"] = environment_to_json();
  write("index.json", pretty_json(j));
  indexed_ = Clock::now();
  indexing_ = indexed_ - begin;
}

void Run::write(const std::filesystem::path& below, const std::string& text) const {
  try {
    make_folder((settings_.folder / below).parent_path());
    write_file(settings_.folder / below, text);
  } catch (const IoError& e) {
    if (counts_.cases() == 0) throw;
    throw IoError(fmt::format("{}; the run ends after {}, {}", e.what(), plural_text(counts_.cases(), "answer"),
                              counts_.violated_text()));
  }
}

void Run::finish() {
  vanished_ = kept_.vanished();
  write_index(interrupted() ? RunState::interrupted : RunState::finished);
  finished_ = true;
}

void Run::write_tables() const {
  write("tables.txt", fmt::format("{}\n{}{}", counts_.table(), counts_.touches_text(), kept_.worst_text()));
}

std::vector<WrittenReport> Run::written_now() const {
  std::vector<WrittenReport> now = kept_.written();
  std::erase_if(now, [](const WrittenReport& w) { return w.earlier; });
  return now;
}

std::optional<std::string> Run::shortfall() const {
  const std::string index = path_text(settings_.folder / "index.json");
  if (interrupted()) {
    return fmt::format("interrupted after {}, {}; {}{}", plural_text(counts_.cases(), "answer"),
                       counts_.violated_text(), index, vanished_.empty() ? "" : "; " + lost_text());
  }
  if (!vanished_.empty()) return lost_text() + "; " + index;
  if (counts_.cases() > 0) return std::nullopt;
  return fmt::format("nothing was asked: the time was over before the first case; {}", index);
}

std::string Run::lost_text() const { return vanished_text(vanished_, kept_.count(), settings_.folder); }

std::string Run::summary() const {
  const double seconds = Campaign::seconds_since(begin_);
  return fmt::format("{}{} in {} ({}/s): {}; {} in {}{}{}{}", interrupted() ? "interrupted: " : "",
                     plural_text(counts_.cases(), "answer"), duration_text(seconds),
                     count_text(std::uint64_t(double(counts_.cases()) / std::max(seconds, 1e-3))),
                     counts_.violated_text(), plural_text(kept_.count(), "report"), path_text(settings_.folder),
                     vanished_.empty() ? "" : "; " + lost_text(), scene_measure_text(), internal_errors().text());
}

int Run::exit_code() const {
  if (internal_errors().count() > 0) return InternalError::exit_code;
  return counts_.bad() > 0 ? 1 : shortfall() ? 2 : 0;
}

}  // namespace nearmiss
