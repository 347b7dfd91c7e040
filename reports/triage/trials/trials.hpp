/// Asks a subject changed cases of a finding, and tells which of them have the same finding.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "reports/findings/finding_kind.hpp"
#include "reports/findings/workers.hpp"
#include "reports/triage/causes/cause.hpp"

namespace nearmiss {

enum class Outcome {
  same,   ///< the finding of the case that is explained
  other,  ///< another bad finding
  right,  ///< nothing is proved against the answer
  none,   ///< not asked, without an answer, or outside of the contract's domain
};

/// Whether every number is finite and of the case's scalar, and the query has such a case.
bool is_valid(const Case& c);

/// A changed case with the subject's answer.
struct Trial {
  Case question;
  Answer answer;
  Finding finding;
  Outcome outcome = Outcome::none;
  std::uint8_t raised = 0;  ///< exceptions (Raised), of a case asked in a given rounding
};

/// Not thread-safe.
class Trials {
 public:
  Trials(const Case& question, const Subject& subject, const CauseLimits& limits, Workers& workers);

  /// The case itself; its outcome is `right` or `none` where it has no bad finding.
  const Trial& base() const { return base_; }
  const Subject& subject() const { return subject_; }
  Workers& workers() const { return workers_; }
  const Query& query() const { return *base_.question.query; }
  bool sets_rounding() const { return Workers::sets_rounding(subject_); }

  /// One trial for each case, in order. Cases that are not valid, not exact in the scalar or beyond the limits have the
  /// outcome `none`. In another rounding than its own, answers have the raised exceptions.
  std::vector<Trial> ask(std::span<const Case> cases, Rounding rounding = Rounding::its_own);
  /// Judges an answer by the subject's standard.
  Finding judged(const Case& c, const Answer& answer) const;
  /// The finding of a trial, with its distances.
  Finding in_full(const Trial& t) const;
  /// Nothing is proved against the answer.
  bool is_right(const Case& c, const Answer& answer) const;

  /// A limit was reached, or the user interrupted.
  bool is_over() const;
  std::uint64_t questions() const { return questions_; }

 private:
  using Clock = std::chrono::steady_clock;
  Outcome outcome_of(const Finding& f) const;

  const Subject& subject_;
  Workers& workers_;
  CauseLimits limits_;
  Clock::time_point begin_ = Clock::now();
  Detail detail_ = Detail::verdict;
  KindKey kind_;
  Standard standard_for(const Query& q) const;

  Trial base_;
  std::uint64_t questions_ = 0;
};

std::size_t count(std::span<const Trial> trials, Outcome outcome);
/// Those that have an outcome: "cannot answer" is neither right nor wrong.
std::size_t count_answered(std::span<const Trial> trials);

/// `count` cases in which each number that may move is up to `ulps` units in the last place away. Zeros stay. So many
/// ulps make equal numbers different in nearly every case.
std::vector<Case> ulp_neighbours(const Case& c, std::size_t count, int ulps, std::uint64_t seed);
/// `count` cases in which each number is, at random, as it is or multiplied by a factor in 1 +- 2^-order.
std::vector<Case> relative_neighbours(const Case& c, std::size_t count, int order, std::uint64_t seed);
/// `count` cases in which each zero is, at random, as it is or a number of up to 2^-order of the largest of its role.
/// None where no number that may move is 0.
std::vector<Case> with_moved_zeros(const Case& c, std::size_t count, int order, std::uint64_t seed);
/// At most `most` cases around that of `trials` with the same finding, as different from it as possible.
std::vector<Trial> variants(Trials& trials, std::size_t most, std::uint64_t seed);

/// A seed that depends on the case alone.
std::uint64_t seed_of(const Case& c);

}  // namespace nearmiss
