/// How often, and by how much, a subject is wrong on fresh cases of a scene.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "reports/engine/dispatcher.hpp"
#include "reports/engine/internal_errors.hpp"
#include "reports/trade/sources.hpp"
#include "reports/trade/summary.hpp"

namespace nearmiss {

/// The largest error of one kind. The largest error of all answers lies between both numbers.
struct LargestError {
  double proved = 0;   ///< a lower bound
  double at_most = 0;  ///< an upper bound
};

/// What is proved of a subject's answers to `cases` cases. Lengths are in the unit of the tolerance, times in seconds.
struct SceneEvidence {
  const Subject* subject = nullptr;
  const Query* query = nullptr;
  std::uint64_t seed = 0, cases = 0;
  std::uint64_t answered = 0;
  std::uint64_t unanswered = 0;    ///< the subject has no answer, was not asked or broke
  std::uint64_t not_finite = 0;    ///< answers with NaN or infinity
  std::uint64_t beyond = 0;        ///< of no use: is_beyond()
  std::uint64_t by_intervals = 0;  ///< intervals alone prove that the answer is good enough
  LargestError distance;           ///< of places and depths, in answers with the right decision
  LargestError time;               ///< of times of impact, in answers with the right decision
  double missed_depth = 0;         ///< the largest proved depth of a missed contact
  double phantom_gap = 0;          ///< the largest proved gap of a phantom contact
  Rate missed_deeper;              ///< of the contacts: those that are missed by more than is tolerable
  Rate phantom_wider;              ///< of the reported contacts: those that are none by more than is tolerable
  std::optional<Case> worst;       ///< the case whose answer uses up most of the tolerance; empty: no error is proved
  double worst_use = 0;            ///< the share of the tolerance that it uses up; above 1: too much

  /// True where every case was asked: neither an interrupt nor a failure ended the measurement.
  bool is_complete() const { return answered + unanswered == cases; }
  /// The requirements that these figures are about, and the time of a call, where it is known.
  std::vector<MetRequirement> requirements(const TradeTolerance& tolerance, std::optional<double> nanoseconds) const;
};

/// What a measurement asks.
struct EvidenceSettings {
  const Subject* subject = nullptr;
  const Query* query = nullptr;
  const TradeSource* source = nullptr;
  std::uint64_t seed = 1, cases = 0;
  bool until_failure = false;  ///< end after the batch with which a requirement can no longer be met
};

/// Asks a subject the cases 0 ... cases - 1 of a stream. Each answer is judged by intervals first. Where they leave
/// open whether it is good enough, it is judged by exact numbers. `goes_on` is called with the number of judged cases
/// of each batch; false, or an interrupt, ends the measurement.
SceneEvidence measured_evidence(const EvidenceSettings& settings, Dispatcher& dispatcher,
                                InternalErrors& internal_errors, const std::function<bool(std::uint64_t)>& goes_on);

}  // namespace nearmiss
