/// One worker process for each subject, started when it is first asked.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "impl/catalogue/case.hpp"
#include "impl/host/worker.hpp"

namespace nearmiss {

/// Not for use from several threads. Throws std::system_error where a process cannot be started.
class Workers {
 public:
  /// `on_wait` is called while a host is awaited; false gives it up.
  explicit Workers(Worker::WaitCallback on_wait = {}) : on_wait_(std::move(on_wait)) {}

  /// The subject must offer the case's query. For a batch, `cases` are all of one query. A case outside of what the
  /// subject requires does not reach it; what is received in place of an answer is answer_of_unasked().
  Answer ask(const Subject& subject, const Case& question);
  /// At most `capacity_for` cases. Several subjects may be sent to before the first is received from;
  /// what is received stays valid until the subject is sent to again.
  void send(const Subject& subject, std::span<const Case> cases);
  std::span<const Answer> receive(const Subject& subject);
  /// What the subject's host had written when this case of the last batch broke (Worker::output).
  std::string_view output(const Subject& subject, std::size_t case_of_batch) const;

  /// Of processor time, that the subject's process has used.
  double processor_seconds(const Subject& subject) const;

  static std::size_t capacity_for(const Query& query);
  /// The most cases of one batch: the fewer, the more isolation costs (docs/isolation.md).
  static constexpr std::size_t batch = Worker::capacity;

 private:
  struct Asked {
    std::unique_ptr<Worker> worker;
    bool all = true;                  ///< the last batch was asked as it is
    std::vector<std::size_t> inside;  ///< or these cases of it
    std::vector<Answer> answers;      ///< and this is what is received of it
  };
  Asked& of(const Subject& subject);

  Worker::WaitCallback on_wait_;
  std::map<const Subject*, Asked> workers_;
  std::vector<double> flat_;
};

Answer answer_of_given_up();

/// The same numbers as a case in another scalar; empty where it cannot hold one of them exactly.
std::optional<Case> in_scalar(const Case& question, Scalar scalar);

}  // namespace nearmiss
