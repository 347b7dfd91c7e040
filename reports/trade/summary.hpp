/// What a trade says of one subject on one query.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "impl/subject/subject.hpp"
#include "reports/trade/errors.hpp"
#include "reports/trade/statistics.hpp"
#include "reports/trade/times.hpp"

namespace nearmiss {

/// A requirement, and whether a subject meets it on the measured cases.
struct MetRequirement {
  enum class State {
    shown,   ///< met; a rate is below its limit with 95 % confidence, or no rate is required
    so_far,  ///< met by the measured cases, which are too few to show it
    failed,
  };
  std::string name;  ///< "missed contacts"
  double limit = 0, worst = 0;
  std::string unit;  ///< of both; empty: a share or a count
  State state = State::failed;
};
std::string_view name_of(MetRequirement::State s);

/// The figures of a subject that requirements are about.
struct RequiredFigures {
  std::uint64_t unanswered = 0;       ///< cases without an answer
  std::uint64_t not_finite = 0;       ///< answers with NaN or infinity
  std::optional<double> shift;        ///< the largest backward error of the inputs
  std::optional<double> distance;     ///< the largest error of a place or depth
  std::optional<double> time;         ///< the largest error of a time of impact
  Rate missed_deeper, phantom_wider;  ///< beyond what is tolerable, of the contacts and of the reported contacts
  std::optional<double> nanoseconds;  ///< of a call in sequence
};
std::vector<MetRequirement> requirements_of(const RequiredFigures& figures, const TradeTolerance& tolerance);
/// "error of places and depths: 0.5 metre, at most 0.01".
std::string failure_text(const MetRequirement& r);
/// True if none failed.
bool none_failed(std::span<const MetRequirement> requirements);

/// What one stage of a subject costs.
struct StageCost {
  AnswerStage stage = AnswerStage::unknown;
  Rate calls;                            ///< the answers that it gave, of all timed cases
  std::optional<Quantiles> nanoseconds;  ///< of a call that it answers
  double mean = 0;                       ///< of these calls, in nanoseconds
  double share_of_time = 0;              ///< calls times mean, of the time of all timed cases
};
/// For each known stage that gave an answer; empty for a subject without stages.
std::vector<StageCost> stage_costs(const TradeTimes& times);

/// One in 10^3 … 10^6 answers.
inline constexpr std::array<std::uint64_t, 4> tail_sizes = {1000, 10'000, 100'000, 1'000'000};

/// All numbers are sampled: they hold for the measured cases.
struct TradeSummary {
  const Subject* subject = nullptr;
  std::uint64_t compared = 0, no_answer = 0, not_asked = 0;
  Rate broke;          ///< of all asked cases
  Rate missed;         ///< of the contacts
  Rate phantom;        ///< of the reported contacts
  Rate missed_deeper;  ///< of the contacts: those that are missed by more than is tolerable
  Rate phantom_wider;  ///< of the reported contacts: those that are none by more than is tolerable
  Rate beyond;         ///< of all asked cases: answers that are of no use (is_beyond)
  std::optional<Quantiles> missed_depth, phantom_gap;          ///< of these answers, in the unit
  std::optional<Quantiles> ulps, distance, time;               ///< of answers with the right decision
  std::optional<Quantiles> backward, shift;                    ///< of all compared answers
  std::array<std::optional<double>, tail_sizes.size()> tails;  ///< of `shift`
  TimedHow timed = TimedHow::not_timed;
  bool pinned = false;
  std::optional<Quantiles> nanoseconds;          ///< over the cases
  std::optional<Quantiles> repeats, sequential;  ///< over the repeats; see TradeTimes
  std::vector<StageCost> stages;                 ///< of a subject that answers in stages
  double least_repeat = 0, least_sequential = 0;
  std::vector<MetRequirement> requirements;
  bool on_front = false;  ///< of the median call and the largest error

  bool meets_all() const;
  /// The median call; empty where it is not timed.
  std::optional<double> cost() const;
};

/// Puts the answers and the times of a subject together; `on_front` is not set.
TradeSummary summarised(const Subject& subject, std::span<const TradeAnswer> answers, const TradeTimes& times,
                        const TradeTolerance& tolerance);
/// Sets `on_front`.
void mark_front(std::span<TradeSummary> subjects);
/// The subject with the least cost that meets all requirements; nullptr where none does.
const TradeSummary* cheapest(std::span<const TradeSummary> subjects);

}  // namespace nearmiss
