/// The time of calls, of many subjects on the same cases.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "reports/findings/workers.hpp"

namespace nearmiss {

/// How the calls of a subject were measured.
enum class TimedHow {
  not_timed,
  typed,       ///< calls of typed functions
  as_offered,  ///< calls through an interface that takes plain numbers, which it decodes
  round_trip,  ///< a batch through pipes, divided by its cases
};
/// "typed calls", "calls with decoding", "round trips through pipes", "not timed".
std::string_view name_of(TimedHow how);

/// The times of a subject on the cases of a query.
struct TradeTimes {
  TimedHow how = TimedHow::not_timed;
  bool pinned = false;
  std::vector<double> of_case;  ///< nanoseconds of each case's call, the median of the repeats; NaN: not timed
  std::vector<AnswerStage> stage_of_case{};  ///< of each case; unknown: it is not timed, or the subject has no stages
  std::vector<double> repeats;               ///< the median call of each repeat
  std::vector<double> sequential;            ///< of each repeat: processor nanoseconds of a call, of calls in sequence
};

/// A subject, and the cases that it is asked: those that it can answer.
struct TimedSubject {
  const Subject* subject;
  std::vector<Case> cases;              ///< in the subject's scalar
  std::vector<std::size_t> of_measure;  ///< the index of each case in the measurement
};

/// Times all subjects in turn, `repeats` times. `total` is the number of cases of the measurement. Stops early when
/// `goes_on` says so; a subject whose call breaks is not timed.
std::vector<TradeTimes> trade_times(std::span<const TimedSubject> subjects, std::size_t total, unsigned repeats,
                                    Workers& workers, const std::function<bool()>& goes_on);

}  // namespace nearmiss
