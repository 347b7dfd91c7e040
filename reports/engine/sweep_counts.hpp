/// Asks one subject the floats of a slice in this process, and counts what differs from the truth.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "corpus/files/file_value.hpp"
#include "impl/subject/subject.hpp"
#include "oracles/confirmed.hpp"
#include "reports/engine/slice.hpp"

namespace nearmiss {

/// A violation, by the position of its float (float_at).
struct SweptViolation {
  std::uint64_t at = 0;
  double above = -1;  ///< its proved bound; negative: none
};

/// The counts of one subject. False hits and false misses are never added together.
struct SweepCounts {
  std::uint64_t asked = 0;
  std::uint64_t false_hits = 0, false_misses = 0;
  std::uint64_t not_finite = 0;      ///< answers with a NaN, or with an infinity other than the time of a miss
  std::uint64_t negative_times = 0;  ///< of a hit or of a miss
  std::uint64_t no_answer = 0, broke = 0;
  std::uint64_t judged = 0;   ///< the answers that any of the counts above has
  std::uint64_t outside = 0;  ///< of the judged ones, those to which the contract does not apply
  std::uint64_t violations = 0;
  std::uint64_t internal_errors = 0;
  double worst_backward = -1;                  ///< the largest proved bound of a judged answer; negative: none
  double seconds = 0, judge_seconds = 0;       ///< of processors: in all, and of that in the judge
  std::optional<SweptViolation> first, worst;  ///< violations: at the lowest float, and with the largest bound

  void add(const SweepCounts& other);
  void add_violation(const SweptViolation& v);
  /// The subject broke a promise, or broke.
  std::uint64_t bad() const { return violations + broke; }
};

nlohmann::ordered_json sweep_counts_to_json(const SweepCounts& c);
/// Throws BadInput for another document.
SweepCounts sweep_counts_from_json(const FileValue& j);

class SweepAsker {
 public:
  SweepAsker(const Slice& slice, const Subject& subject);

  /// Asks every float from `begin` up to, without, `end`; their exact decision is `yes`. False where `stopped` became
  /// true. Throws std::logic_error where the judge finds another exact decision.
  bool ask(std::uint64_t begin, std::uint64_t end, bool yes, const std::function<bool()>& stopped);

  const SweepCounts& counts() const { return counts_; }
  const std::vector<InternalError>& internal_errors() const { return internal_errors_; }

 private:
  void ask_all(std::uint64_t begin, std::uint64_t end, bool yes);
  bool has_bad_number(const Answer& a) const;
  void examine(std::uint64_t at, const Answer& a, bool yes);
  void count(const Answer& a, bool yes);
  void judge_at(std::uint64_t at, const Answer& a, bool yes);

  const Slice& slice_;
  const AnswerFunction answer_;
  const Standard standard_;
  const std::size_t outputs_;
  std::optional<std::size_t> time_;  ///< the output that is the time of contact
  std::vector<double> values_;
  Case question_;  ///< for the judge
  SweepCounts counts_;
  std::vector<InternalError> internal_errors_;
};

}  // namespace nearmiss
