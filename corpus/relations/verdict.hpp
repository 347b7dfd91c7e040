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

/// What a subject broke by its answers to related cases.
enum class Breach {
  none,           ///< nothing that can be proved
  contradiction,  ///< decisions that cannot both be right, but no promise: the judge shows which one is wrong
  bits,           ///< it claims to answer alike bit for bit, and does not
  contract,       ///< the judge proves an answer to be beyond its contract
  broke,          ///< it gave no answer to one of them
};
std::string_view name_of(Breach b);

/// What came of one relation for one case and one subject.
struct RelationFinding {
  const Relation* relation = nullptr;
  std::vector<Case> cases;        ///< the case itself first
  std::vector<Answer> answers;    ///< one each
  std::vector<Finding> findings;  ///< the judge's word on each; empty where the answers are the same
  Agreement agreement = Agreement::same;
  Breach breach = Breach::none;
  std::string broken;  ///< what proves that a promise is broken; empty up to Breach::contradiction
  std::string oracle;  ///< what proves the oracle wrong; empty where nothing does
};

/// Answers that differ are not yet a fault: rounding may make them differ. A promise is broken by what the judge proves
/// against one of them or, where `bit_for_bit` is claimed, by any difference that a bitwise relation does not allow.
/// `answers`: to the case and to its follow-ups, in order; the subject offers all of their queries.
RelationFinding relate(const Relation& relation, const FollowUps& follow_ups, const Case& question,
                       std::vector<Answer> answers, const Subject& subject, bool bit_for_bit);

/// Whether the subject claims that scaled cases have answers that are alike bit for bit: the tiers of `collide` do.
bool claims_same_bits(const Subject& subject);

using Ask = std::function<Answer(const Case&)>;

/// Asks the subject about the case and its follow-ups. Empty: no follow-ups, one of them is not offered, or one of the
/// cases is outside of what the subject requires.
std::optional<RelationFinding> examine(const Relation& relation, const Case& question, std::uint64_t seed,
                                       const Subject& subject, const Ask& ask, bool bit_for_bit = false);
/// Whether the subject offers the query of each of the follow-ups.
bool offers_all(const Subject& subject, const FollowUps& follow_ups);
/// Whether each of the follow-ups is inside of what the subject requires.
bool may_be_asked_all(const Subject& subject, const FollowUps& follow_ups);

}  // namespace nearmiss
