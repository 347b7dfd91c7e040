/// The random case generator. Most cases are near a degeneracy.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// The `index`-th case of the stream `seed`: the same on every machine, valid, and exact in `scalar`. Built from the
/// roles and names of the query's inputs alone. About half of the cases are scenes: smooth numbers of moderate size,
/// hits and misses mixed. The other half start from a scene, which mutators then change (Case::moves).
///
/// Numbers stay within 2^18 for float and 2^60 for double, except in about one case in 40 whose last mutator is an
/// extreme one. `query` must outlive the calling thread's last call. Thread-safe.
Case generate(const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index);
/// The same into an existing case, whose memory is reused.
void generate(Case& into, const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index);

/// One entry of the closed table of mutators.
struct MutatorName {
  std::string_view name;  ///< "far-offset"
  std::string_view what;  ///< one line for people
  bool extreme = false;   ///< may make numbers of any magnitude
};
/// Every mutator, in the order of application.
std::span<const MutatorName> mutator_names();
/// The own copy of the name, also of a mutator of lists, which mutate() applies; empty if there is no such mutator.
std::string_view known_mutator(std::string_view name);

/// Whether one of the case's mutators is an extreme one.
bool has_extreme_mutator(const Case& c);
/// Whether a mutator brought features of two shapes together: edges are parallel, shapes touch.
bool has_feature_mutator(const Case& c);

/// Applies 1 to 3 mutators, drawn by `seed`: for fuzzers. The case stays valid and exact in its scalar; the mutators'
/// names are appended to Case::moves.
void mutate(Case& c, std::uint64_t seed);

}  // namespace nearmiss
