/// Sends batches of cases to many subjects at once, each in its own host, and gives up subjects that are often late or
/// break in every case.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reports/findings/workers.hpp"

namespace nearmiss {

/// How a subject has stood the cases of a query.
struct Endurance {
  std::uint64_t asked = 0, late = 0, broke = 0;
  std::uint64_t answered = 0;  ///< also with "cannot answer"
  std::uint64_t gave_up = 0;   ///< cases that were not asked because the subject was given up
  std::string lost{};          ///< why its host could not be started again, where it was asked last

  /// Where at least 8 cases, and at least a twentieth of all, were late.
  bool is_often_late() const { return late >= 8 && 20 * late >= asked; }
  bool always_broke() const { return answered == 0; }
};

/// "X was late 8 times of QUERY, and was not asked 142 more cases"; "X broke in each of its first 64 cases of QUERY,
/// and was …"; "X cannot be started again (WHY), and was … of QUERY".
std::string given_up_text(std::string_view subject, std::string_view query, const Endurance& e);

class Dispatcher {
 public:
  enum class GiveUp { when_often_broken, never };
  /// A subject that broke in all cases so far, of every query, is given up on a query after so many breakages in a row,
  /// of any queries, if at least so many of them are of the query. One that breaks in 9 of 10 cases breaks in its first
  /// 64 with a chance of 0.9^64 = 0.1 %: what is given up has next to nothing to say, and to start a program again
  /// takes a third of a second.
  static constexpr std::uint64_t most_broken_in_row = 64, least_broken_of_query = 8;

  /// `on_wait` is called while a host is awaited; false ends the waiting.
  explicit Dispatcher(Worker::WaitCallback on_wait, GiveUp rule = GiveUp::when_often_broken)
      : workers_(std::move(on_wait)), rule_(rule) {}

  /// Sends the cases to all subjects, runs `meanwhile`, and passes the answers of each subject to `take`: fewer answers
  /// than cases where the waiting was stopped, or the subject given up. The cases are of one query and exact in the
  /// subjects' scalars. A subject that is given up gets none: one that is often late with the cases of the query; one
  /// that has answered none of them, and has broken most_broken_in_row times in a row; and one whose host cannot be
  /// started any more.
  void ask(std::span<const Subject* const> subjects, std::span<const Case> cases,
           const std::function<void()>& meanwhile,
           const std::function<void(const Subject&, std::span<const Answer>)>& take);

  const Endurance& endurance(const Subject& subject, const Query& query) { return endurance_[{&subject, &query}]; }
  const std::map<std::pair<const Subject*, const Query*>, Endurance>& all_endurance() const { return endurance_; }
  /// Counts cases that a subject was not asked.
  void pass_over(const Subject& subject, const Query& query, std::uint64_t cases) {
    endurance_[{&subject, &query}].gave_up += cases;
  }
  Workers& workers() { return workers_; }

 private:
  bool is_given_up(const Subject& subject, const Query& query);
  std::uint64_t most_broken(const Subject& subject, const Query& query);
  void count(const Subject& subject, const Query& query, std::span<const Answer> answers);

  Workers workers_;
  GiveUp rule_;
  std::map<std::pair<const Subject*, const Query*>, Endurance> endurance_;
  std::map<const Subject*, std::uint64_t> broken_in_row_;  ///< of any queries
  std::map<const Subject*, std::string> lost_;             ///< why its host cannot be started again
};

}  // namespace nearmiss
