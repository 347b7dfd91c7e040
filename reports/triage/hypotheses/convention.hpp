/// Tests whether a finding comes from another meaning of the inputs or of the answer.
#pragma once

#include "reports/triage/hypotheses/asked_cases.hpp"

namespace nearmiss {

/// The first reading of readings() that explains the case, nearly all others with the finding, and generated ones.
Tested convention_of(AskedCases& asked);

}  // namespace nearmiss
