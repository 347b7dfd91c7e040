#include "impl/host/timing.hpp"

#include <sched.h>

#include <algorithm>
#include <vector>

#include "impl/subject/contained.hpp"
#include "impl/subject/timed_calls.hpp"

namespace nearmiss {

namespace {

constexpr unsigned rounds_of_batch = 25;
constexpr double least_nanoseconds = 0.1;               ///< of a call: below the cost of any
constexpr std::int64_t most_nanoseconds = 250'000'000;  ///< of processor time, after which no round begins

/// Keeps the thread on its highest allowed processor for its lifetime.
class PinnedThread {
 public:
  PinnedThread() {
    if (sched_getaffinity(0, sizeof before_, &before_) != 0) return;
    int last = CPU_SETSIZE - 1;
    while (last >= 0 && !CPU_ISSET(last, &before_)) --last;
    if (last < 0) return;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(last, &one);
    is_pinned_ = sched_setaffinity(0, sizeof one, &one) == 0;
  }
  ~PinnedThread() {
    if (is_pinned_) sched_setaffinity(0, sizeof before_, &before_);
  }
  PinnedThread(const PinnedThread&) = delete;
  PinnedThread& operator=(const PinnedThread&) = delete;
  bool is_pinned() const { return is_pinned_; }

 private:
  cpu_set_t before_{};
  bool is_pinned_ = false;
};

template <class T>
T median_of(std::vector<T> values) {
  if (values.empty()) return T{};
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The mean without the samples that are far above the median: those of calls during which the thread lost the
/// processor. A mean, because the counter of some machines advances by ten nanoseconds at once: the difference of two
/// readings is then exact only on average.
double mean_without_pauses(const std::vector<std::uint64_t>& samples) {
  if (samples.empty()) return 0;
  const double most = 2.0 * double(median_of(samples)), far = std::max(most, 1.0);
  double sum = 0, count = 0;
  for (const std::uint64_t s : samples) {
    if (double(s) > far) continue;
    sum += double(s);
    ++count;
  }
  return sum / count;
}

[[gnu::noinline]] int empty_call(const int& x) { return x; }

/// The ticks between begin() and end() around a call that does nothing.
double ticks_of_empty_call() {
  const std::vector<int> none(2000);
  TimedRounds rounds;
  rounds.most = 1;
  time_calls<int>(none, empty_call, rounds);
  return mean_without_pauses(rounds.ticks);
}

/// A reading of both clocks: the ticks lie within `width` of those at the time `nanoseconds`.
struct ClockReading {
  std::int64_t nanoseconds = 0;
  std::uint64_t ticks = 0, width = 0;
};

/// The narrowest of some readings: a thread that loses the processor between the two clocks makes a wide one.
ClockReading read_clocks() {
  ClockReading narrowest;
  for (int i = 0; i < 20; ++i) {
    const std::uint64_t before = CallClock::begin();
    const std::int64_t now = CallClock::nanoseconds(CLOCK_MONOTONIC);
    const std::uint64_t width = CallClock::end() - before;
    if (i == 0 || width < narrowest.width) narrowest = {now, before + width / 2, width};
  }
  return narrowest;
}

/// Nanoseconds of a tick, from a wait of at least two milliseconds.
double nanoseconds_of_tick() {
  const ClockReading from = read_clocks();
  while (CallClock::nanoseconds(CLOCK_MONOTONIC) < from.nanoseconds + 2'000'000) {
  }
  const ClockReading to = read_clocks();
  return double(to.nanoseconds - from.nanoseconds) / double(std::max<std::uint64_t>(1, to.ticks - from.ticks));
}

/// Times the calls of `answer`, which decodes the inputs itself.
void time_erased(const AnswerFunction& answer, const CaseNumbers& numbers, TimedRounds& rounds) {
  std::vector<std::span<const double>> cases;
  for (std::size_t i = 0; i < numbers.size(); ++i) cases.push_back(numbers[i]);
  time_calls<std::span<const double>>(cases, answer, rounds);
}

TimedRounds timed_rounds(const OfferedFunctions& offer, const CaseNumbers& numbers) {
  TimedRounds rounds;
  rounds.most = rounds_of_batch;
  rounds.until = CallClock::nanoseconds(CLOCK_THREAD_CPUTIME_ID) + most_nanoseconds;
  if (offer.time != nullptr) {
    offer.time(numbers, rounds);
  } else {
    time_erased(offer.answer, numbers, rounds);
  }
  return rounds;
}

/// The stage that answers each case.
std::vector<AnswerStage> stages_of(const OfferedFunctions& offer, const CaseNumbers& numbers) {
  std::vector<AnswerStage> stages;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const StageTally before = offer.stages();
    use_value(offer.answer(numbers[i]));
    stages.push_back(last_stage_between(before, offer.stages()));
  }
  return stages;
}

/// The time of each case's call in nanoseconds, without the cost of the clock; at least a tenth of a nanosecond.
std::vector<double> nanoseconds_of(const TimedRounds& rounds, std::size_t cases) {
  static const double of_tick = nanoseconds_of_tick();
  const double empty = ticks_of_empty_call();
  std::vector<double> times;
  for (std::size_t i = 0; i < cases; ++i) {
    std::vector<std::uint64_t> ticks;
    for (std::size_t at = i; at < rounds.ticks.size(); at += cases) ticks.push_back(rounds.ticks[at]);
    times.push_back(std::max(least_nanoseconds, of_tick * (mean_without_pauses(ticks) - empty)));
  }
  return times;
}

}  // namespace

void time_batch(const OfferedFunctions& offer, const wire::SharedRequest& asked, wire::SharedAnswers& answered) {
  const std::size_t first = asked.first, count = asked.count, cases = count - first;
  const CaseNumbers numbers = asked.numbers(first, count);
  std::vector<double> times;
  std::vector<AnswerStage> stages(cases, AnswerStage::unknown);
  const Answer outcome = answer_or_broke([&] {
    const PinnedThread pinned;
    const TimedRounds rounds = timed_rounds(offer, numbers);
    times = nanoseconds_of(rounds, cases);
    if (offer.stages != nullptr) stages = stages_of(offer, numbers);
    answered.timed = {double(median_of(rounds.processor)) / double(cases), std::uint32_t(rounds.processor.size()),
                      offer.time != nullptr, pinned.is_pinned()};
    return Answer{};
  });
  const bool ok = outcome.status == Answer::Status::answered;
  for (std::size_t i = 0; i < cases; ++i) {
    Answer a = outcome;
    a.yes = true;
    if (ok) a.count = 2, a.values[0] = times[i], a.values[1] = double(stages[i]);
    wire::put(answered, first + i, asked.numbers_at + 2 * i, wire::head_of(asked.batch, first + i, a, 0), a);
  }
  answered.done.store(std::uint32_t(count), std::memory_order_release);
}

}  // namespace nearmiss
