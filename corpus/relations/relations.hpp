/// Metamorphic relations: an exactly representable change of a case, and the change of the exact answer that follows.
/// No tolerance is involved, and a violation shows without knowing the truth.
#pragma once

#include "corpus/relations/follow_ups.hpp"

namespace nearmiss {

/// An entry of the closed table of relations.
struct Relation {
  std::string_view name;  ///< "scaled-lengths"
  std::string_view what;  ///< one line for people
  /// Every operation of an implementation without epsilons commutes with the change, including its rounding.
  bool bitwise = false;
  /// The follow-ups of a case, chosen by `seed` if there is a choice; empty if there are none.
  std::optional<FollowUps> (*of)(const Case& question, std::uint64_t seed) = nullptr;
};
std::span<const Relation> relations();
/// nullptr if there is none of that name.
const Relation* find_relation(std::string_view name);

}  // namespace nearmiss
