/// One worker for each subject, started at its first case.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "impl/catalogue/case.hpp"
#include "impl/host/worker.hpp"

namespace nearmiss {

/// Not thread-safe. Throws std::system_error where a process cannot be started, and BadSubject where the second
/// hello of a program differs from its first.
class Workers {
 public:
  /// `on_wait` is called while a host is awaited; false stops the waiting.
  explicit Workers(Worker::WaitCallback on_wait = {}) : on_wait_(std::move(on_wait)) {}

  /// The subject must offer the case's query; all cases of a batch are of one query. A case that does not meet the
  /// subject's preconditions is not sent to it: its answer is answer_of_unasked().
  Answer ask(const Subject& subject, const Case& question);
  /// Sends at most `capacity_for` cases. Several subjects may get cases before the first receive(); received answers
  /// stay valid until the next send() to the subject.
  void send(const Subject& subject, std::span<const Case> cases, Rounding rounding = Rounding::its_own);
  /// Stops where the first `most_broken` sent cases all broke (Worker::receive).
  std::span<const Answer> receive(const Subject& subject, std::size_t most_broken = Worker::capacity);
  /// True where this case of the last batch meets the subject's preconditions, so that it was sent.
  bool was_sent(const Subject& subject, std::size_t case_of_batch) const;
  /// Why the subject's host cannot be started any more (Worker::lost); empty where it can.
  std::string lost(const Subject& subject) const;
  /// The output of the subject's host when this case of the last batch broke (Worker::output).
  std::string_view output(const Subject& subject, std::size_t case_of_batch) const;

  /// Times the subject's calls for these cases, at most `capacity_for`, which meet its preconditions (Worker::time).
  std::optional<Worker::Times> time(const Subject& subject, std::span<const Case> cases);

  /// The exceptions that this case of the last batch raised (Worker::raised).
  std::uint8_t raised(const Subject& subject, std::size_t case_of_batch) const;
  /// Whether the subject can be asked in a given rounding: not a program behind pipes.
  static bool sets_rounding(const Subject& subject) {
    return !subject.host || subject.host->batches == HostProgram::Batches::shared;
  }

  /// The processor time of the subject's process.
  double processor_seconds(const Subject& subject) const;

  static std::size_t capacity_for(const Query& query);
  /// The most cases in a batch. Smaller batches raise the cost of isolation (docs/measured/isolation.md).
  static constexpr std::size_t batch = Worker::capacity;

 private:
  struct Asked {
    std::unique_ptr<Worker> worker;
    bool all = true;                  ///< every case of the last batch was sent
    std::vector<std::size_t> inside;  ///< otherwise the indices of the sent cases
    std::vector<Answer> answers;      ///< and the answers to the whole batch
  };
  Asked& of(const Subject& subject);
  void add(const Case& c);
  std::span<const Answer> received(Asked& asked, std::size_t most_broken);
  /// The position of this case among the cases that were sent; empty where it was not sent.
  std::optional<std::size_t> sent_at(const Asked& asked, std::size_t case_of_batch) const;

  Worker::WaitCallback on_wait_;
  std::map<const Subject*, Asked> workers_;
  std::vector<double> flat_;            ///< the numbers of the cases that are sent next
  std::vector<std::uint32_t> lengths_;  ///< of each of these cases
};

/// The answer to a case that was not asked because the waiting was stopped.
Answer answer_of_given_up();

/// The same case in another scalar; empty where the scalar cannot hold every number exactly.
std::optional<Case> in_scalar(const Case& question, Scalar scalar);

}  // namespace nearmiss
