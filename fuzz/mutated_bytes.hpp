/// The generator's mutators as a mutation of bytes, for an engine that has neither the oracle nor the subjects.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "corpus/generator/generator.hpp"
#include "corpus/storage/fuzz_target.hpp"

namespace nearmiss {

/// A case near a special configuration, as bytes: the case in `bytes` after 1 to 3 moves of the generator, or a
/// generated case where `bytes` hold none. `seed` alone decides which.
inline std::vector<std::uint8_t> mutated_case(const FuzzTarget& target, std::span<const std::uint8_t> bytes,
                                              std::uint64_t seed) {
  if (auto c = target.case_of(bytes)) {
    mutate(*c, seed);
    return target.bytes_of(*c);
  }
  const Query& query = *target.queries[seed / 4 % target.queries.size()];
  return target.bytes_of(generate(query, seed % 4 < 2 ? Scalar::float32 : Scalar::float64, seed, 0));
}

}  // namespace nearmiss
