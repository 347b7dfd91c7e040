/// Relations between the exact answers of cases: what a change of the input that is exactly representable
/// must do to the answer. No tolerance takes part, and no truth is needed to see that one is broken.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "impl/subject/subject.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {

/// How two answers that have the same exact ones, but for a known change, compare.
enum class Agreement {
  same,              ///< in every number, bit for bit but for the sign of zero
  numbers_differ,    ///< the same decision
  decisions_differ,  ///< at least one of the two decisions is wrong
};
std::string_view name_of(Agreement a);

/// The cases that a case is related to, and what their answers must have in common.
struct Partners {
  std::vector<Case> cases;
  /// Compares the answer to the case itself with those to its partners, in order.
  std::function<Agreement(const Answer& own, std::span<const Answer> others)> compare;
  /// Where there is one partner and its right answers are those of the case, changed: that change. What has
  /// no counterpart is not given.
  std::function<Answer(const Answer& own)> image;
  /// What is right within an ulp has such an image. Not so where the change moves numbers to another grid.
  bool image_keeps_ulps = true;
  /// Decisions that contradict each other are so whatever the numbers are; otherwise a wrong number may be at fault.
  bool decisions_alone = true;
};

/// An entry of the closed table of relations.
struct Relation {
  std::string_view name;  ///< "scaled-lengths"
  std::string_view what;  ///< one line for people
  /// Every operation of an implementation without epsilons commutes with the change, rounding included.
  bool bitwise = false;
  /// The partners of a case, chosen by `seed` where there is a choice; empty where there are none.
  std::optional<Partners> (*of)(const Case& question, std::uint64_t seed) = nullptr;
};
std::span<const Relation> relations();
/// nullptr when there is none of that name.
const Relation* find_relation(std::string_view name);

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
/// `answers`: to the case and to its partners, in order; the subject offers all of their queries.
RelationFinding relate(const Relation& relation, const Partners& partners, const Case& question,
                       std::vector<Answer> answers, const Subject& subject, bool bit_for_bit);

/// Whether the subject claims that scaled cases have answers that are alike bit for bit: the tiers of `collide` do.
bool claims_same_bits(const Subject& subject);

using Ask = std::function<Answer(const Case&)>;

/// Asks the subject about the case and its partners. Empty: no partners, one of them is not offered, or one of the cases is
/// outside of what the subject requires.
std::optional<RelationFinding> examine(const Relation& relation, const Case& question, std::uint64_t seed,
                                       const Subject& subject, const Ask& ask, bool bit_for_bit = false);
/// Whether the subject offers the query of each of the partners.
bool offers_all(const Subject& subject, const Partners& partners);
/// Whether each of the partners is inside of what the subject requires.
bool may_be_asked_all(const Subject& subject, const Partners& partners);

}  // namespace nearmiss
