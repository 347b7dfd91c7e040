/// Cases by number: random, but most of them near something.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// The `index`-th case of the stream `seed`: the same on every machine, valid, and exact in `scalar`.
/// Built from the roles and names of the query's inputs alone. About half are scenes: smooth numbers of
/// moderate size, hits and misses mixed. The others start from one and are then changed by named
/// moves (Case::moves).
///
/// Numbers stay within 2^18 for float and 2^60 for double, but for one case in about 40 that an extreme move changed
/// last. `query` must outlive the calling thread's
/// last call. Thread-safe.
Case generate(const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index);
/// The same into an existing case, whose memory is used again.
void generate(Case& into, const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index);

/// One entry of the closed table of moves.
struct MutatorName {
  std::string_view name;  ///< "far-offset"
  std::string_view what;  ///< one line for people
  bool extreme = false;   ///< numbers of any magnitude come of it
};
/// Every move, in the order in which they are applied when several are.
std::span<const MutatorName> mutator_names();
/// The table's own copy of the name; empty when there is no such move.
std::string_view known_mutator(std::string_view name);

/// Whether one of the case's moves is an extreme one.
bool has_extreme_mutator(const Case& c);

/// Changes the case by 1 to 3 moves, drawn by `seed`: for fuzzers. It stays valid and exact in its
/// scalar; its moves are appended.
void mutate(Case& c, std::uint64_t seed);

}  // namespace nearmiss
