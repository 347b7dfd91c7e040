/// What is proved against the answers of a trade, and what is tolerated.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "impl/subject/subject.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {

/// What a scene requires of the answers to a query. Lengths are in `unit`.
struct TradeTolerance {
  std::string unit;                   ///< of lengths; empty: shares of the largest length of the case
  double error = 0;                   ///< the largest tolerable error of a place or a depth
  double missed_depth = 0;            ///< of a contact that an answer misses
  std::optional<double> time;         ///< the largest tolerable error of a time of impact; empty: any
  double missed_rate = 0;             ///< of the contacts, those that may be missed more deeply
  double phantom_rate = 0;            ///< of the reported contacts, those that may be none by more than `error`
  std::optional<double> nanoseconds;  ///< of a call; empty: any
  std::string source;
};
/// The tolerance without a scene: for the backward error, as a share of the largest number of each group.
TradeTolerance relative_tolerance(double error, const std::string& source);

/// What is proved against one answer. The numbers are lower bounds; 0: nothing is proved.
struct TradeAnswer {
  enum class State : std::uint8_t { not_asked, compared, no_answer, broke } state = State::not_asked;
  bool truth_yes = false, yes = false;
  bool missed = false, phantom = false, not_finite = false;
  double backward = 0;  ///< relative to the largest number of each group
  double shift = 0;     ///< the backward error of lengths, in the unit of the tolerance
  double ulps = 0;      ///< the forward error of an answer with the right decision
  double distance = 0;  ///< of its places and depths, in the unit of the tolerance
  double time = 0;      ///< of its time of impact, in the time of the query
};

/// What the subject is asked: the case's numbers in the subject's scalar. The case is then one of float where either
/// scalar is float, so that unit vectors of float count as unit vectors for a subject in double.
Case asked_case(const Case& question, Scalar scalar);
/// The judge measures in the wider of both scalars, which holds the case exactly.
Case judged_case(const Case& question, Scalar scalar);
/// Promises nothing, so that every answer is measured, by what the subject declares. Preconditions are checked before a
/// subject is asked.
Standard unbounded_standard(Conventions declared = {});
/// The preconditions of all of the subjects for this query.
Preconditions all_required(std::span<const Subject* const> subjects, const Query& query);

/// `scalar` is the subject's; that of the case may be wider (see Trade).
TradeAnswer trade_answer(const Case& question, Scalar scalar, const Answer& answer, const Finding& finding,
                         const TradeTolerance& tolerance);
/// True for an answer that a scene with this tolerance cannot use: the subject broke, a number is not finite, or the
/// answer is proved to be wrong by more. Without a unit, the backward error alone counts.
bool is_beyond(const TradeAnswer& a, const TradeTolerance& tolerance);

}  // namespace nearmiss
