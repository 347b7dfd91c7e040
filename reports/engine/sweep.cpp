#include "reports/engine/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "corpus/files/errors.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/subject/contained.hpp"
#include "reports/engine/counts.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/kept_reports.hpp"
#include "reports/findings/pretty_json.hpp"

namespace nearmiss {

namespace {

using namespace std::chrono_literals;

constexpr const char* state_name = "sweep.json";
constexpr auto between_states = 500ms;

/// Appends the truth of the next floats.
void extend(SweptRange& range, const SweptRange& next) {
  for (const TruthRange& t : next.truth) append(range.truth, t);
  range.end = next.end;
}

}  // namespace

void insert(std::vector<SweptRange>& done, const SweptRange& range) {
  const auto behind = std::upper_bound(done.begin(), done.end(), range.begin,
                                       [](std::uint64_t at, const SweptRange& r) { return at < r.begin; });
  auto at = done.insert(behind, range);
  if (at + 1 != done.end() && at->end == (at + 1)->begin) {
    extend(*at, *(at + 1));
    done.erase(at + 1);
  }
  if (at != done.begin() && (at - 1)->end == at->begin) {
    extend(*(at - 1), *at);
    done.erase(at);
  }
}

Sweep::Sweep(SweepSettings settings)
    : settings_(std::move(settings)),
      internal_errors_(settings_.folder),
      counts_(settings_.subjects.size()),
      started_(std::chrono::steady_clock::now()) {
  make_folder(settings_.folder);
  lock_.emplace(settings_.folder);
  if (std::filesystem::exists(settings_.folder / state_name)) load();
  reports_ = reports_on_disk(settings_.folder);
  write();
}

/// The floats that are not done, in chunks that begin at multiples of the size of a chunk.
std::vector<SweptRange> Sweep::left() const {
  std::vector<SweptRange> chunks;
  const auto add = [&](std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t at = begin; at < end;) {
      const std::uint64_t next = std::min(end, (at / chunk + 1) * chunk);
      chunks.push_back({at, next, {}});
      at = next;
    }
  };
  std::uint64_t at = settings_.begin;
  for (const SweptRange& r : done_) {
    add(at, r.begin);
    at = r.end;
  }
  add(at, settings_.end);
  return chunks;
}

bool Sweep::stopping() const { return interrupted() || failed_; }

void Sweep::run() {
  const std::vector<SweptRange> chunks = left();
  std::uint64_t floats = 0;
  for (const SweptRange& c : chunks) floats += c.end - c.begin;
  progress_.set_activity(fmt::format("{}, {}", settings_.slice.query().name, settings_.slice.field().name));
  std::vector<std::thread> threads;
  working_ = settings_.jobs;
  for (unsigned i = 0; i < settings_.jobs; ++i) threads.emplace_back([&] { work_or_fail(chunks); });
  wait_for_threads(floats);
  for (std::thread& t : threads) t.join();
  collect();
  write_reports();
  write();
  if (failure_) std::rethrow_exception(failure_);
}

void Sweep::work_or_fail(const std::vector<SweptRange>& chunks) {
  try {
    work(chunks);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
    failed_ = true;
  }
  --working_;
}

void Sweep::work(const std::vector<SweptRange>& chunks) {
  while (!stopping()) {
    const std::size_t mine = next_++;
    if (mine >= chunks.size()) return;
    std::optional<ChunkResult> result = examine(chunks[mine]);
    if (!result) return;
    const std::lock_guard lock(mutex_);
    finished_.push_back(std::move(*result));
  }
}

/// Empty where it was stopped.
std::optional<Sweep::ChunkResult> Sweep::examine(const SweptRange& floats) const {
  const auto stopped = [this] { return stopping(); };
  ChunkResult result{{floats.begin, floats.end, settings_.slice.truth(floats.begin, floats.end, stopped)}, {}, {}};
  const std::vector<TruthRange>& truth = result.range.truth;
  if (truth.empty()) return std::nullopt;
  for (std::size_t s = 0; s < settings_.subjects.size(); ++s) {
    SweepAsker asker(settings_.slice, settings_.subjects[s]);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const std::uint64_t end = i + 1 < truth.size() ? truth[i + 1].begin : floats.end;
      if (truth[i].truth == SliceTruth::invalid) continue;
      if (!asker.ask(truth[i].begin, end, truth[i].truth == SliceTruth::yes, stopped)) return std::nullopt;
    }
    result.counts.push_back(asker.counts());
    for (const InternalError& e : asker.internal_errors()) result.internal_errors.emplace_back(s, e);
  }
  return result;
}

void Sweep::wait_for_threads(std::uint64_t floats) {
  constexpr auto between_looks = 50ms;
  const std::uint64_t before = floats_done(true) + floats_done(false);
  while (working_ > 0) {
    std::this_thread::sleep_for(between_looks);
    collect();
    const std::uint64_t done = floats_done(true) + floats_done(false) - before;
    progress_.show(done * counts_.size(), floats * counts_.size(), std::nullopt, bad());
    if (std::chrono::steady_clock::now() - written_ >= between_states) write();
  }
}

void Sweep::collect() {
  std::vector<ChunkResult> results;
  {
    const std::lock_guard lock(mutex_);
    results.swap(finished_);
  }
  for (const ChunkResult& r : results) take(r);
}

void Sweep::take(const ChunkResult& result) {
  insert(done_, result.range);
  for (std::size_t s = 0; s < counts_.size(); ++s) counts_[s].add(result.counts[s]);
  for (const auto& [subject, error] : result.internal_errors) internal_errors_.add(settings_.subjects[subject], error);
}

void Sweep::write() {
  write_file(settings_.folder / state_name, pretty_json(to_json()));
  written_ = std::chrono::steady_clock::now();
}

/// Writes a report of the violation at the lowest float and of the one with the largest bound, for each subject.
void Sweep::write_reports() {
  if (bad() == 0) return;
  const Query& query = settings_.slice.query();
  std::vector<const Subject*> subjects;
  for (const Subject& s : settings_.subjects) subjects.push_back(&s);
  Counts counts({&query}, subjects, false);
  KeptReports kept(settings_.folder, counts, [this](const std::filesystem::path& below, const std::string& text) {
    make_folder((settings_.folder / below).parent_path());
    write_file(settings_.folder / below, text);
  });
  Workers workers;
  kept.ask_with(workers);
  for (std::size_t s = 0; s < subjects.size(); ++s) {
    if (!counts_[s].first) continue;
    std::vector<std::uint64_t> at{counts_[s].first->at};
    if (counts_[s].worst->at != at.front()) at.push_back(counts_[s].worst->at);
    for (const std::uint64_t position : at) {
      const Case question = settings_.slice.at(position);
      const Offering& offering = subjects[s]->offering(query.name);
      const Answer answer = answer_or_broke([&] { return offering.answer(question.values); });
      const Finding finding = confirmed(question, answer, subjects[s]->standard_for(query.name), Detail::full);
      const Examined examined{question, *subjects[s], answer, finding, ""};
      counts.take(examined);
      kept.take(examined);
    }
  }
  kept.end_batch();
  reports_ = reports_on_disk(settings_.folder);
}

bool Sweep::is_complete() const {
  const std::uint64_t asked = floats_done(true);
  const bool all_asked =
      std::all_of(counts_.begin(), counts_.end(), [&](const SweepCounts& c) { return c.asked == asked; });
  return all_asked && done_.size() == 1 && done_[0].begin == settings_.begin && done_[0].end == settings_.end;
}

bool Sweep::is_exhaustive() const { return is_complete() && settings_.begin == 0 && settings_.end == finite_floats; }

std::uint64_t Sweep::floats_done(bool valid) const {
  std::uint64_t floats = 0;
  for (const SweptRange& r : done_) {
    for (std::size_t i = 0; i < r.truth.size(); ++i) {
      const std::uint64_t end = i + 1 < r.truth.size() ? r.truth[i + 1].begin : r.end;
      if ((r.truth[i].truth != SliceTruth::invalid) == valid) floats += end - r.truth[i].begin;
    }
  }
  return floats;
}

std::uint64_t Sweep::bad() const {
  std::uint64_t all = 0;
  for (const SweepCounts& c : counts_) all += c.bad();
  return all;
}

std::uint64_t Sweep::internal_errors() const {
  std::uint64_t all = 0;
  for (const SweepCounts& c : counts_) all += c.internal_errors;
  return all;
}

double Sweep::seconds() const {
  return seconds_before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

int Sweep::exit_code() const {
  if (internal_errors() > 0) return InternalError::exit_code;
  return bad() > 0 ? 1 : is_complete() ? 0 : 2;
}

}  // namespace nearmiss
