/// Sends batches of cases to many subjects at once, each in its own host, and gives up subjects that are often late.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "reports/findings/workers.hpp"

namespace nearmiss {

/// How often a subject was late with the cases of a query.
struct Lateness {
  std::uint64_t asked = 0, late = 0;
  std::uint64_t gave_up = 0;  ///< cases that were not asked because too many were late

  /// True where at least 8 cases, and at least a twentieth of all, were late.
  bool gives_up() const { return late >= 8 && 20 * late >= asked; }
};

class Dispatcher {
 public:
  enum class GiveUp { when_often_late, never };

  /// `on_wait` is called while a host is awaited; false ends the waiting.
  explicit Dispatcher(Worker::WaitCallback on_wait, GiveUp rule = GiveUp::when_often_late)
      : workers_(std::move(on_wait)), rule_(rule) {}

  /// Sends the cases to all subjects, runs `meanwhile`, and passes the answers of each subject to `take`: fewer answers
  /// than cases where the waiting was stopped. The cases are of one query and exact in the subjects' scalars. A subject
  /// that is given up gets none.
  void ask(std::span<const Subject* const> subjects, std::span<const Case> cases,
           const std::function<void()>& meanwhile,
           const std::function<void(const Subject&, std::span<const Answer>)>& take);

  const Lateness& lateness(const Subject& subject, const Query& query) { return lateness_[{&subject, &query}]; }
  const std::map<std::pair<const Subject*, const Query*>, Lateness>& all_lateness() const { return lateness_; }
  /// Counts cases that a subject was not asked.
  void pass_over(const Subject& subject, const Query& query, std::uint64_t cases) {
    lateness_[{&subject, &query}].gave_up += cases;
  }
  Workers& workers() { return workers_; }

 private:
  bool is_given_up(const Subject& subject, const Query& query);

  Workers workers_;
  GiveUp rule_;
  std::map<std::pair<const Subject*, const Query*>, Lateness> lateness_;
};

}  // namespace nearmiss
