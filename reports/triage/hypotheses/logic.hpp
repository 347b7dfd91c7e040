/// Tests whether a finding comes from the logic of the subject.
#pragma once

#include "reports/triage/hypotheses/asked_cases.hpp"

namespace nearmiss {

/// Nothing that changes arithmetic alone changes the finding.
Tested logic_of(AskedCases& asked);

}  // namespace nearmiss
