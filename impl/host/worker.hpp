/// Asks a subject in a process of its own, so that a crash or an endless loop costs one case and not the run.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "impl/host/replies.hpp"
#include "impl/host/supervisor.hpp"
#include "impl/host/wire.hpp"
#include "impl/subject/stages.hpp"
#include "impl/subject/subject.hpp"

namespace nearmiss {

struct WorkerLimits {
  double case_timeout = 2.0;                 ///< seconds of processor time for one case
  std::size_t bytes = std::size_t{2} << 30;  ///< of memory, beyond the memory at the start of the process
  bool pid_namespace = true;                 ///< see Confinement
  /// Seconds of wall time for one case, without the time in which other processes had the processor.
  double wall() const { return 5 * case_timeout; }
  /// The limits of a hello: a process may take longer to start than to answer.
  WorkerLimits of_start() const {
    WorkerLimits start = *this;
    start.case_timeout = std::max(case_timeout, 1.0);
    return start;
  }
};

/// The default limits, from the command line.
const WorkerLimits& worker_limits();
void set_worker_limits(const WorkerLimits& limits);

/// Reports why a host sent no hello, or another hello than at its first start.
struct HostFailed : std::runtime_error {
  enum Why { ended, done, late, another_hello };  ///< done: it left with exit code 0
  explicit HostFailed(const std::string& text, Why reason = ended) : std::runtime_error(text), why(reason) {}
  Why why;
};

/// How many numbers each case of a batch has.
class CaseLengths {
 public:
  /// All cases have the same count.
  CaseLengths(std::size_t each) : each_(each) {}
  /// One count for each case. The list must outlive this object.
  CaseLengths(std::span<const std::uint32_t> of_each) : of_each_(of_each) {}
  CaseLengths(const std::vector<std::uint32_t>& of_each) : of_each_(of_each) {}

  /// How many cases so many numbers are.
  std::size_t cases(std::size_t numbers) const { return each_ > 0 ? numbers / each_ : of_each_.size(); }
  std::size_t operator[](std::size_t i) const { return each_ > 0 ? each_ : of_each_[i]; }
  /// Those of the cases [from, end).
  CaseLengths part(std::size_t from, std::size_t end) const {
    return each_ > 0 ? *this : CaseLengths(of_each_.subspan(from, end - from));
  }

 private:
  std::size_t each_ = 0;
  std::span<const std::uint32_t> of_each_;
};

/// Sends batches of cases to a host process and receives its answers. The host is a program that sends a hello, or a
/// fork of this process for a subject of this program. The host can read the cases, but no other data of this process
/// (see supervisor.hpp). Where the host throws, aborts, crashes, hangs, exceeds a memory limit or sends a malformed
/// answer, the case gets an answer with the status `broke` and the reason (with the line of the host's output that
/// holds the error, if any), and a new host continues with the next case. One batch at a time; not thread-safe.
///
/// A host breaks in a request of many cases, and only some events tell which case it was: a host that shares memory
/// counts its answers, and a malformed answer may name its case. After any other event the cases without an answer are
/// asked again, in small requests (end_of_next_request), until one breaks the host alone. Where none does, the first of
/// them is `broke`, with not_again_suffix: no second try erases what has happened. The exception is a time limit of a
/// request whose cases, asked again, take at least half of that time together: they are slow, not late.
///
/// Throws std::system_error when the operating system refuses a process or memory for some seconds. No answer records
/// this as a fault of the subject. Throws HostFailed where a host that has not answered yet sends another hello than
/// at its first start.
class Worker {
 public:
  /// Called about twenty times a second while a host is awaited; false stops the waiting.
  using WaitCallback = std::function<bool()>;

  explicit Worker(WorkerLimits limits = {}, std::shared_ptr<const HostProgram> program = nullptr,
                  WaitCallback on_wait = {});
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Starts the program without waiting for its hello.
  void begin();
  /// The hello of the program, a line of at most wire::max_hello bytes. Throws HostFailed.
  std::string hello();

  /// Sends the cases with these numbers, at most `capacity` cases and max_values numbers. The host works while
  /// the caller does other work; `receive` waits for the answers, in the order of the cases. Answers stay valid until
  /// the next send. `receive` returns fewer answers than cases where the callback stopped the waiting, where
  /// `most_late` cases of the batch were late, where its first `most_broken` cases all broke, and where the host is
  /// lost. A host that shares memory answers in `rounding`; any other host in its own.
  void send(const Offering& offering, std::span<const double> values, const CaseLengths& lengths,
            Rounding rounding = Rounding::its_own);
  std::span<const Answer> receive(std::size_t most_broken = capacity);
  /// Why no host can be started: the last `most_failed_starts` attempts failed, or it sends another hello. Empty after
  /// a start that succeeded.
  const std::string& lost() const { return lost_; }
  /// The last bytes, a few thousand at most, of the host's standard output and error when the case broke; empty for any
  /// other case. Valid as long as the received answers.
  std::string_view output(std::size_t case_of_batch) const;

  /// The floating-point exceptions (Raised) of a case that was sent in a rounding other than its_own and was answered;
  /// 0 for any other case. Valid as long as the received answers.
  std::uint8_t raised(std::size_t case_of_batch) const { return raised_.at(case_of_batch); }

  /// Times the calls for these cases, at most `capacity` and max_values numbers: nanoseconds for each case, the mean
  /// of the batch's rounds, and the stage that answers it. Empty where the host answers through pipes, where a call
  /// broke or the host was late, and where the callback stopped the waiting.
  struct Times {
    std::vector<double> nanoseconds;
    wire::TimedBatch how;
    std::vector<AnswerStage> stages{};
  };
  std::optional<Times> time(const Offering& offering, std::span<const double> values, const CaseLengths& lengths);

  /// The processor time of the running host; 0 without one.
  double processor_seconds() const;

  /// Sends and receives any number of cases.
  std::vector<Answer> ask(const Offering& offering, std::span<const double> values, const CaseLengths& lengths);

  static constexpr std::size_t most_late = 8, most_failed_starts = 3;
  static constexpr std::size_t capacity = wire::capacity;
  static constexpr std::size_t max_values = wire::max_values;

 private:
  using Clock = std::chrono::steady_clock;
  struct Child;
  class CaseTimeout;
  /// The result of waiting for a host.
  struct Event {
    enum What { all_answered, broke, late, not_asked, gave_up } what;
    std::string reason{};
    bool is_of_next_case = false;  ///< the next case certainly broke, not a later one
    bool is_of_any_case = false;   ///< also one that is answered may have caused it
    BreakCause cause = BreakCause::other;
    std::string output{};
  };
  /// Seconds that a request took, without the time in which other processes had the processor.
  struct Took {
    double processor = 0, wall = 0;
  };
  /// A host that broke in a request, by one of the cases [at, end).
  struct Suspicion {
    Event event;
    std::size_t at, end;
    bool is_earlier = false;  ///< the host broke before the request, by no case of it
    Took again{};             ///< by the cases, asked again
  };
  struct Output {
    std::size_t of;
    std::string text;
  };

  bool is_shared() const { return program_ == nullptr || program_->batches == HostProgram::Batches::shared; }
  void start();
  void spawn();
  void spawn_once();
  void wait_for_resources(int error);
  std::string first_line();
  void put_request(const Offering& offering, std::span<const double> values, const CaseLengths& lengths);
  void request(std::size_t first, std::size_t end);
  std::size_t end_of_next_request();
  std::optional<Event> event_between_requests();
  Event await();
  std::optional<Event> read_shared_answers();
  std::optional<Event> event_of_shared_end();
  std::optional<Event> read_piped_answers();
  Event event_of_end();
  Event end_as(Event::What what, std::string reason, bool is_of_next_case = false);
  Event end_as_of_any(std::string reason);
  bool is_searching() const { return !suspicions_.empty(); }
  bool searches_one_by_one() const;
  bool take_failed_start();
  void take(Event event);
  void take_answered();
  Took took() const;
  bool was_only_slow(const Suspicion& s) const;
  void settle(std::size_t end);
  bool broke_from_the_start(std::size_t most) const;
  void poison();
  bool is_poison_intact() const;
  void mark_broken(std::size_t i, const Event& event, std::string_view suffix = {});
  void end();
  bool keeps_waiting() const { return !on_wait_ || on_wait_(); }
  bool flush();
  const std::vector<std::uint64_t>& gives();
  std::size_t& piped_at_once();
  void adapt(Clock::duration took);

  WorkerLimits limits_;
  std::shared_ptr<const HostProgram> program_;
  WaitCallback on_wait_;
  int asked_file_ = -1, answered_file_ = -1;  // declared before the mappings of these files
  wire::SharedRequest* asked_;
  wire::SharedAnswers* answered_;
  std::unique_ptr<Child> child_;
  std::unique_ptr<CaseTimeout> timeout_;
  std::optional<HostFailed> cannot_start_;
  std::string lost_;
  std::size_t failed_starts_ = 0;  ///< since the last start that succeeded
  bool has_answered_ = false;      ///< some case, at any time
  bool decides_ = true;            ///< the query has a decision
  bool heard_ = false;             ///< some bytes arrived through the pipe since the request
  bool is_unreadable_ = false;     ///< the shared memory holds something that is no answer
  std::size_t outputs_ = 0;        ///< required count of numbers in an answer; 0: any
  std::vector<std::uint64_t> gives_;
  wire::Due due_{};                                  ///< but for its number
  std::size_t count_ = 0;                            ///< cases in the batch
  std::size_t got_ = 0;                              ///< cases that are answered or broke
  std::size_t late_ = 0;                             ///< cases of the batch that were late
  std::size_t numbers_begin_ = 0, numbers_got_ = 0;  ///< in shared memory: of the request, and read of it
  std::size_t first_requested_ = 0, requested_ = 0;  ///< the cases of the request: [first, end)
  std::uint32_t requests_ = 0;                       ///< through shared memory
  Clock::time_point requested_since_{};
  double processor_before_ = 0, run_queue_before_ = 0;  ///< seconds of the host, at the request
  std::optional<Clock::time_point> refused_since_;      ///< since when the system has refused processes or memory
  Clock::time_point looked_{};                          ///< the last check of time and memory limits
  std::vector<std::size_t> piped_at_once_;              ///< most cases in a request over a pipe, for each offer
  std::size_t again_at_once_ = 1;                       ///< the same for cases that are asked again
  std::vector<Suspicion> suspicions_;                   ///< each within the range of the one before
  std::string query_;
  std::vector<Answer> answers_;  ///< of the last batch
  std::vector<std::uint8_t> raised_;
  std::vector<Output> broken_;
};

}  // namespace nearmiss
