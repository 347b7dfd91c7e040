/// Tests whether numbers that the subject computes leave the range of its scalar.
#pragma once

#include "reports/triage/hypotheses/asked_cases.hpp"

namespace nearmiss {

/// Overflow or underflow, from the exceptions that were raised at each scale.
Tested number_range_of(AskedCases& asked);

}  // namespace nearmiss
