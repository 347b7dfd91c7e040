/// Cases in which nothing is scene-like, for what must hold for every valid input.
#pragma once

#include <cstdint>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// A case of raw numbers that keeps the query's rules: any finite bits, each exponent as likely as any other;
/// one number in eight is zero, one in eight repeats another. The same for the same seed on every machine.
Case raw_case(const Query& query, Scalar scalar, std::uint64_t seed);

/// The `index`-th case of the generator's stream `seed` with each of its vectors, sizes and rotations scaled by
/// a power of two of its own: by 1, by the scalar's largest or smallest, or by any between. What no longer keeps
/// the query's rules stays as it was.
Case far_scaled_case(const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index);

}  // namespace nearmiss
