/// Asks a subject in a process of its own, so that whatever it does is an answer and nothing more.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "impl/subject/subject.hpp"

namespace nearmiss {

struct WorkerLimits {
  double seconds_per_case = 2.0;             ///< that pass, but for those in which others had the processor
  std::size_t bytes = std::size_t{2} << 30;  ///< of address space beyond what the process starts with
};

/// A child process that answers batches of cases. A case is written to shared memory before it is
/// asked. A child that throws, aborts, crashes, hangs or eats memory gives that case the answer
/// `broke` with the reason (for an abort the last line that it wrote to standard error); a new child
/// goes on with the next case. Processes that it started end with it, unless they left its process group. One batch
/// at a time; not for use from several threads. A child begins with the standard modes of floating-point arithmetic; what the
/// subject makes of them in its own process is its own matter.
///
/// Throws std::system_error when the operating system refuses a process or memory.
class Worker {
 public:
  explicit Worker(WorkerLimits limits = {});
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Answers to values.size() / inputs_per_case cases, in order. Until `receive` the caller is free to
  /// do other work: the child runs beside it. At most `capacity` cases and max_values numbers. What is received stays
  /// valid until the next send.
  void send(const Offering& offering, std::span<const double> values, std::size_t inputs_per_case);
  std::span<const Answer> receive();

  /// send and receive, for any number of cases.
  std::vector<Answer> ask(const Offering& offering, std::span<const double> values, std::size_t inputs_per_case);

  static constexpr std::size_t capacity = 2048;
  static constexpr std::size_t max_values = capacity * 64;

 private:
  struct Shared;
  struct Child;
  void start();
  void end();
  void release();
  bool has_ended() const;
  std::string how_it_ended(bool timed_out);

  WorkerLimits limits_;
  Shared* shared_;
  std::unique_ptr<Child> child_;
  std::vector<Answer> answers_;  ///< of the batch that was received last
};

}  // namespace nearmiss
