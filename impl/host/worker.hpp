/// Asks a subject in a process of its own, so that whatever it does is an answer and nothing more.
#pragma once

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

#include "impl/host/supervisor.hpp"
#include "impl/host/wire.hpp"
#include "impl/subject/subject.hpp"

namespace nearmiss {

struct WorkerLimits {
  double case_timeout = 2.0;                 ///< seconds of processor time for a case
  std::size_t bytes = std::size_t{2} << 30;  ///< of memory, beyond what the process starts with
  bool pid_namespace = true;                 ///< see Confinement
  /// Seconds that may pass for a case, but for those in which others had the processor; and until a host says hello.
  double wall() const { return 5 * case_timeout; }
};

/// For all that have none of their own: those of the command line. For the rest of the process.
const WorkerLimits& worker_limits();
void set_worker_limits(const WorkerLimits& limits);

/// Why a host did not come to its hello, or not to the one that it said first.
struct HostFailed : std::runtime_error {
  explicit HostFailed(const std::string& why, bool is_late = false) : std::runtime_error(why), late(is_late) {}
  bool late;  ///< a time limit was reached
};

/// A process, called a host, that answers batches of cases: a program that says of itself what it offers, or a copy of
/// this process for a subject of this program. It has nothing of this process but the cases (see keeper.hpp). One that
/// throws, aborts, crashes, hangs, eats memory or answers with what is no answer gives that case the answer `broke`
/// with the reason (where it wrote something, its last line); a new host goes on with the next case. One batch at a
/// time; not for use from several threads.
///
/// Throws std::system_error when the operating system refuses a process or memory, for some seconds: no subject is
/// blamed for that.
class Worker {
 public:
  /// Called some twenty times a second while a host is awaited; false gives it up.
  using WaitCallback = std::function<bool()>;

  explicit Worker(WorkerLimits limits = {}, std::shared_ptr<const HostProgram> program = nullptr,
                  WaitCallback on_wait = {});
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Starts the program, without awaiting its hello.
  void begin();
  /// What the program says of itself, a line of at most wire::max_hello bytes. Throws HostFailed.
  std::string hello();

  /// Answers to values.size() / inputs_per_case cases, in order. Until `receive` the caller is free to
  /// do other work: the host runs beside it. At most `capacity` cases and max_values numbers. What is received stays
  /// valid until the next send. It is less than what was asked where the on_wait gave up, and where `most_late` cases
  /// of the batch were late.
  void send(const Offering& offering, std::span<const double> values, std::size_t inputs_per_case);
  std::span<const Answer> receive();
  /// The end of what the host had written when the case broke: standard output and error, some thousand bytes at most;
  /// empty for any other case. Valid as long as what was received.
  std::string_view output(std::size_t case_of_batch) const;

  /// Of processor time, that the host which runs now has used; 0 without one.
  double processor_seconds() const;

  /// send and receive, for any number of cases.
  std::vector<Answer> ask(const Offering& offering, std::span<const double> values, std::size_t inputs_per_case);

  static constexpr std::size_t most_late = 8;
  static constexpr std::size_t capacity = wire::capacity;
  static constexpr std::size_t max_values = wire::max_values;

 private:
  using Clock = std::chrono::steady_clock;
  struct Child;
  class CaseTimeout;
  /// What came of waiting.
  struct Event {
    enum What { all_answered, broke, late, not_asked, gave_up } what;
    std::string reason{};
    bool is_of_one_case = false;  ///< it is the next case that broke, surely
    BreakCause cause = BreakCause::other;
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
  void request(std::size_t first, std::size_t end);
  Event await();
  std::optional<Event> read_shared_answers();
  std::optional<Event> read_piped_answers();
  Event event_of_end();
  Event end_as(Event::What what, std::string reason, bool is_of_one_case = false);
  void mark_broken(std::size_t i, std::string_view reason, std::string output, BreakCause cause);
  void end();
  bool keeps_waiting() const { return !on_wait_ || on_wait_(); }
  bool flush();
  void adapt(Clock::duration took);

  WorkerLimits limits_;
  std::shared_ptr<const HostProgram> program_;
  WaitCallback on_wait_;
  int asked_file_ = -1, answered_file_ = -1;  // before what is mapped of them
  wire::SharedRequest* asked_;
  wire::SharedAnswers* answered_;
  std::unique_ptr<Child> child_;
  std::unique_ptr<CaseTimeout> timeout_;
  std::optional<HostFailed> cannot_start_;
  bool decides_ = true;          ///< an answer's yes says something
  bool heard_ = false;           ///< something came by the pipe since the request
  std::size_t outputs_ = 0;      ///< numbers of the answers, where the host must give them
  std::size_t count_ = 0;        ///< cases of the batch
  std::size_t got_ = 0;          ///< answered, or broke
  std::size_t numbers_got_ = 0;  ///< of the request, in shared memory
  std::size_t requested_ = 0;    ///< up to this case
  Clock::time_point requested_since_{};
  std::optional<Clock::time_point> refused_since_;  ///< the system has no process or memory
  Clock::time_point looked_{};                      ///< at how long it takes, and how much memory
  std::size_t piped_at_once_ = 64;                  ///< cases of a request over a pipe, at most
  bool one_by_one_ = false;  ///< which of them broke a host that answers late is found out by asking one by one
  std::optional<Event> suspected_;
  std::size_t suspected_at_ = 0;
  std::string suspected_output_, suspected_with_;
  std::string query_;
  std::vector<Answer> answers_;  ///< of the batch that was received last
  std::vector<Output> broken_;
};

}  // namespace nearmiss
