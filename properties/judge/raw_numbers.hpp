/// Cases unlike any scene, for properties that must hold for every valid input.
#pragma once

#include <cstdint>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// A case of raw numbers that keeps the query's rules: any finite bits, each exponent equally likely; one number in
/// eight is zero, one in eight repeats another. The same for the same seed on every machine.
Case raw_case(const Query& query, Scalar scalar, std::uint64_t seed);

/// The `index`-th case of the generator's stream `seed`, with each vector, size and rotation scaled by its own power of
/// two: by 1, by the scalar's largest or smallest, or by one between. A change that would break the query's rules is
/// left out.
Case far_scaled_case(const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index);

}  // namespace nearmiss
