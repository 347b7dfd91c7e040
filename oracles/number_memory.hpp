/// Memory for the numbers of GMP and MPFR, with which the oracles compute.
#pragma once

namespace nearmiss {

/// Gives GMP a pool of its own. Exact numbers are small and short-lived, and malloc takes about a fifth of the time of
/// the exact stage; under the address sanitizer, which does not watch the pool, it takes far more. Call it once, before
/// any thread starts.
void use_pool_for_numbers();

}  // namespace nearmiss
