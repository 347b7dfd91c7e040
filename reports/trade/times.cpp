#include "reports/trade/times.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

namespace nearmiss {

namespace {

constexpr std::size_t timed_at_once = 256;  ///< cases; few, so that a slow subject stays within its time limit

double median_time(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The batches of one repeat of one subject.
struct Repeat {
  std::vector<double> nanoseconds;  ///< of each case
  std::vector<AnswerStage> stages;  ///< of each case
  double sequential = 0;            ///< of a call
  TimedHow how = TimedHow::not_timed;
  bool pinned = false;
};

/// Asks a batch through pipes and divides its time by its cases.
std::optional<Worker::Times> round_trip(const Subject& subject, std::span<const Case> cases, Workers& workers) {
  const auto begin = std::chrono::steady_clock::now();
  workers.send(subject, cases);
  if (workers.receive(subject).size() < cases.size()) return std::nullopt;
  const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
  const double each = took.count() / double(cases.size());
  return Worker::Times{std::vector<double>(cases.size(), each),
                       {each, 1, false, false},
                       std::vector<AnswerStage>(cases.size(), AnswerStage::unknown)};
}

std::optional<Repeat> timed_once(const TimedSubject& timed, Workers& workers) {
  Repeat repeat;
  const bool through_pipes = timed.subject->host && timed.subject->host->batches != HostProgram::Batches::shared;
  for (std::size_t at = 0; at < timed.cases.size(); at += timed_at_once) {
    const std::span<const Case> batch =
        std::span(timed.cases).subspan(at, std::min(timed_at_once, timed.cases.size() - at));
    const auto times = through_pipes ? round_trip(*timed.subject, batch, workers) : workers.time(*timed.subject, batch);
    if (!times) return std::nullopt;
    repeat.nanoseconds.insert(repeat.nanoseconds.end(), times->nanoseconds.begin(), times->nanoseconds.end());
    repeat.stages.insert(repeat.stages.end(), times->stages.begin(), times->stages.end());
    repeat.sequential += times->how.processor_nanoseconds * double(batch.size()) / double(timed.cases.size());
    repeat.how = through_pipes ? TimedHow::round_trip : times->how.typed ? TimedHow::typed : TimedHow::as_offered;
    repeat.pinned = times->how.pinned;
  }
  return repeat;
}

/// The repeats of one subject, put together.
TradeTimes put_together(const TimedSubject& timed, const std::vector<Repeat>& repeats, std::size_t total) {
  TradeTimes times;
  times.of_case.assign(total, std::numeric_limits<double>::quiet_NaN());
  times.stage_of_case.assign(total, AnswerStage::unknown);
  if (repeats.empty()) return times;
  times.how = repeats.front().how;
  times.pinned = repeats.front().pinned;
  for (const Repeat& r : repeats) {
    times.repeats.push_back(median_time(r.nanoseconds));
    times.sequential.push_back(r.sequential);
  }
  for (std::size_t i = 0; i < timed.cases.size(); ++i) {
    std::vector<double> of_repeats;
    for (const Repeat& r : repeats) of_repeats.push_back(r.nanoseconds[i]);
    times.of_case[timed.of_measure[i]] = median_time(std::move(of_repeats));
    times.stage_of_case[timed.of_measure[i]] = repeats.front().stages[i];
  }
  return times;
}

}  // namespace

std::string_view name_of(TimedHow how) {
  switch (how) {
    case TimedHow::typed: return "typed calls";
    case TimedHow::as_offered: return "calls with decoding";
    case TimedHow::round_trip: return "round trips through pipes";
    case TimedHow::not_timed: break;
  }
  return "not timed";
}

std::vector<TradeTimes> trade_times(std::span<const TimedSubject> subjects, std::size_t total, unsigned repeats,
                                    Workers& workers, const std::function<bool()>& goes_on) {
  std::vector<std::vector<Repeat>> measured(subjects.size());
  std::vector<bool> broke(subjects.size());
  for (unsigned r = 0; r < repeats; ++r) {
    for (std::size_t s = 0; s < subjects.size() && goes_on(); ++s) {
      if (broke[s] || subjects[s].cases.empty()) continue;
      if (auto once = timed_once(subjects[s], workers)) {
        measured[s].push_back(std::move(*once));
      } else {
        broke[s] = true;
        measured[s].clear();
      }
    }
  }
  std::vector<TradeTimes> times;
  for (std::size_t s = 0; s < subjects.size(); ++s) times.push_back(put_together(subjects[s], measured[s], total));
  return times;
}

}  // namespace nearmiss
