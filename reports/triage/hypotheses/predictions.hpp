/// What contradicts a cause whose test passed.
#pragma once

#include <optional>

#include "reports/triage/hypotheses/asked_cases.hpp"

namespace nearmiss {

/// The first prediction of the cause that does not hold for the case, with what was seen; empty where all hold.
std::optional<Evidence> contradiction_of(const Named& cause, AskedCases& asked);

}  // namespace nearmiss
