/// What the answers of a subject to a case and to its follow-ups prove.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/relations/relations.hpp"
#include "impl/subject/subject.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {

/// How a subject's answers to related cases break a promise.
enum class Breach {
  none,           ///< no proof of a fault
  contradiction,  ///< the decisions contradict each other without a contract: the judge tells which one is wrong
  bits,           ///< claims bitwise equal answers, but gives different ones
  contract,       ///< the judge proves that an answer breaks its contract
  broke,          ///< no answer to one of them
};
std::string_view name_of(Breach b);

/// The result of one relation for one case and one subject.
struct RelationFinding {
  const Relation* relation = nullptr;
  std::vector<Case> cases;        ///< the case itself first
  std::vector<Answer> answers;    ///< one per case
  std::vector<Finding> findings;  ///< one per case; empty if the answers agree
  Agreement agreement = Agreement::same;
  Breach breach = Breach::none;
  std::string broken;  ///< the proof that a promise is broken; empty up to Breach::contradiction
  std::string oracle;  ///< the proof that the oracle is wrong; empty if there is none
};

/// Different answers are not yet a fault, because rounding may explain them. A promise is broken if the judge proves
/// one of the answers wrong or, where `bit_for_bit` is claimed, by any difference that a bitwise relation does not
/// allow. `answers` are those to the case and to its follow-ups, in order; the subject offers all of their queries.
RelationFinding relate(const Relation& relation, const FollowUps& follow_ups, const Case& question,
                       std::vector<Answer> answers, const Subject& subject, bool bit_for_bit);

/// Whether the subject claims bitwise equal answers to scaled cases: the tiers of `collide` do, but for those that
/// promise exact decisions. Such a tier takes its numbers from one of several computations, by the size of the case:
/// a filter answers for lengths up to 2^60, say, and exact arithmetic beyond.
bool claims_same_bits(const Subject& subject);

using Ask = std::function<Answer(const Case&)>;

/// Asks the subject about the case and its follow-ups. Empty if there are no follow-ups, if the subject does not offer
/// one of them, or if one of the cases breaks a precondition of the subject.
std::optional<RelationFinding> examine(const Relation& relation, const Case& question, std::uint64_t seed,
                                       const Subject& subject, const Ask& ask, bool bit_for_bit = false);
/// Whether the subject offers the query of each follow-up.
bool offers_all(const Subject& subject, const FollowUps& follow_ups);
/// Whether each follow-up meets the preconditions of the subject.
bool may_be_asked_all(const Subject& subject, const FollowUps& follow_ups);

}  // namespace nearmiss
