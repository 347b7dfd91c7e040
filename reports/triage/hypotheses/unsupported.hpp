/// Tests whether a finding comes from a region of the inputs that the subject does not support.
#pragma once

#include "reports/triage/hypotheses/asked_cases.hpp"

namespace nearmiss {

/// The first region of regions_of() in which nearly all answers are wrong, or in which alone some are.
Tested unsupported_of(AskedCases& asked);

}  // namespace nearmiss
