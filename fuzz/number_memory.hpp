/// Memory for the numbers of GMP and MPFR, with which the oracles compute.
#pragma once

namespace nearmiss::fuzz {

/// Gives GMP a pool of its own, which the address sanitizer does not watch: the sanitizer's allocations take a third of
/// a target's time, and the pool is not what is examined. Call it once, before any thread starts.
void use_pool_for_numbers();

}  // namespace nearmiss::fuzz
