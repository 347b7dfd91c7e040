/// Tests whether a finding comes from rounding.
#pragma once

#include "reports/triage/hypotheses/asked_cases.hpp"

namespace nearmiss {

/// For the kernels of `collide`: rounding where the same kernel in exact real numbers is right, logic where it is not.
Tested certified_of(AskedCases& asked);
/// Rounding, from the four rounding modes.
Tested rounding_mode_of(AskedCases& asked);
/// Rounding, after the test of the rounding modes, from cases a few ulps away, and from the scene moved toward the
/// origin.
Tested rounding_of(AskedCases& asked);

}  // namespace nearmiss
