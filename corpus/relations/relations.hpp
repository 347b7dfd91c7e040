/// Relations between the exact answers of cases: what a change of the input that is exactly representable must do to
/// the answer. No tolerance takes part, and no truth is needed to see that one is broken.
#pragma once

#include "corpus/relations/follow_ups.hpp"

namespace nearmiss {

/// An entry of the closed table of relations.
struct Relation {
  std::string_view name;  ///< "scaled-lengths"
  std::string_view what;  ///< one line for people
  /// Every operation of an implementation without epsilons commutes with the change, rounding included.
  bool bitwise = false;
  /// The follow-ups of a case, chosen by `seed` where there is a choice; empty where there are none.
  std::optional<FollowUps> (*of)(const Case& question, std::uint64_t seed) = nullptr;
};
std::span<const Relation> relations();
/// nullptr when there is none of that name.
const Relation* find_relation(std::string_view name);

}  // namespace nearmiss
