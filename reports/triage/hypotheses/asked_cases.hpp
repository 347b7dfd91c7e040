/// What the tests of causes share: trials that several of them use, each asked once.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/triage/causes/tested.hpp"
#include "reports/triage/hypotheses/readings.hpp"
#include "reports/triage/trials/scales.hpp"
#include "reports/triage/trials/trials.hpp"

namespace nearmiss {

/// Not thread-safe. Refers to the trials.
class AskedCases {
 public:
  explicit AskedCases(Trials& trials) : trials_(trials), seed_(seed_of(trials.base().question)) {}

  Trials& trials() const { return trials_; }
  const Case& question() const { return trials_.base().question; }
  std::uint64_t seed() const { return seed_; }
  /// Whether nothing is proved against an answer.
  const IsRight& is_right() const { return is_right_; }

  /// At most 16 other cases with the finding; for a wrong decision, some are generated cases moved to a touch.
  const std::vector<Trial>& similar();
  /// Another case with the finding, of as few regions as there is; nullptr if there is none. For a wrong decision, the
  /// case furthest from a change of the exact decision.
  const Trial* plainest();
  /// At most `most` generated cases with the finding, ordered as for plainest().
  std::vector<Trial> generated_with_finding(std::size_t most);
  /// 256 generated cases, of ordinary numbers.
  const std::vector<Trial>& sample();
  /// 256 other generated cases, of ordinary numbers, to test what the sample has suggested.
  const std::vector<Trial>& fresh();
  /// 64 cases a few ulps away.
  const std::vector<Trial>& neighbours();
  /// The case in the four rounding modes; none for a subject behind pipes.
  const std::vector<Trial>& roundings();
  /// Each of the similar cases in the four rounding modes; none for a subject behind pipes.
  const std::vector<std::vector<Trial>>& similar_roundings();
  /// The case at many scales, in the order of scale_groups().
  const std::vector<ScaleScan>& scans();

  /// The least and the largest error of at most eight of these trials with the finding; empty where one of them has no
  /// number that is off, and where there is none.
  std::optional<std::pair<double, double>> errors_of(std::span<const Trial> trials) const;
  bool same_in_all_roundings();
  /// " and in every rounding mode"; empty for a subject behind pipes, which was not asked in others.
  std::string_view and_in_every_rounding();
  /// The subject's arithmetic on the case was exact: no exception, not even an inexact result.
  bool is_exact();
  /// Generated cases have false hits and false misses: a tolerance errs to one side.
  bool errs_to_both_sides();
  /// The finding is a false hit or a false miss.
  bool is_wrong_decision() const;
  /// What the test of the rounding modes saw, for the tests behind it.
  struct RoundingSeen {
    bool may_round = true;      ///< the errors differ of cases a few ulps away, as rounding errors do
    bool others_depend = true;  ///< most of the other cases with the finding depend on the rounding mode
  };
  const RoundingSeen& rounding_seen() const { return rounding_seen_; }
  /// A tolerance whose value is unknown, which the test of the rounding modes may still tell from rounding errors.
  const std::optional<Named>& unknown_tolerance() const { return unknown_tolerance_; }
  void set_unknown_tolerance(Named tolerance) { unknown_tolerance_ = std::move(tolerance); }
  /// All errors are small shares of the numbers: set by the test of small errors, for that of logic.
  bool has_small_errors() const { return has_small_errors_; }
  void set_small_errors() { has_small_errors_ = true; }
  /// The key of a reading under which the answer to this case is right, but not those to others; or of a region whose
  /// answers have another cause.
  void refute(std::string_view key) { refuted_.emplace_back(key); }
  bool is_refuted(std::string_view key) const {
    return std::find(refuted_.begin(), refuted_.end(), key) != refuted_.end();
  }
  void set_rounding_seen(RoundingSeen seen) { rounding_seen_ = seen; }

 private:
  /// Less for a plainer case.
  double rank_of(const Case& c) const;
  /// Cases of ordinary numbers, from the generator's case `index` on, which becomes that of the next one.
  std::vector<Case> generated(std::size_t count, std::uint64_t& index) const;

  Trials& trials_;
  std::uint64_t seed_;
  IsRight is_right_ = [this](const Case& c, const Answer& a) { return trials_.is_right(c, a); };
  std::optional<std::vector<Trial>> similar_, sample_, fresh_, neighbours_, roundings_;
  std::optional<std::vector<std::vector<Trial>>> similar_roundings_;
  std::optional<std::vector<ScaleScan>> scans_;
  std::uint64_t generated_ = 0;  ///< the generator's next case after the sample
  RoundingSeen rounding_seen_;
  std::optional<Named> unknown_tolerance_;
  bool has_small_errors_ = false;
  std::vector<std::string> refuted_;
};

/// The binary exponent of the largest position or size; 0 where all are zero.
int largest_exponent_of(const Case& c);
/// "3 of 4".
std::string of_text(std::size_t part, std::size_t all);

/// A test of one hypothesis, which collects what was seen.
class TestOfCause {
 public:
  explicit TestOfCause(AskedCases& asked) : asked_(asked) {}
  Tested finished(std::optional<Named> named) { return {std::move(named), std::move(evidence_)}; }

 protected:
  void saw(std::string test, std::string result, std::vector<CauseKind> against = {}) {
    evidence_.push_back({std::move(test), std::move(result), std::move(against)});
  }
  Trials& trials() const { return asked_.trials(); }
  const Case& question() const { return asked_.question(); }

  AskedCases& asked_;

 private:
  std::vector<Evidence> evidence_;
};

}  // namespace nearmiss
