/// Tests whether a finding comes from a relative tolerance, and finds its value.
#pragma once

#include <span>

#include "reports/triage/causes/tested.hpp"
#include "reports/triage/trials/trials.hpp"

namespace nearmiss {

/// The subject's answer jumps where a ratio of two quantities of the case has one value, the same for several moved
/// numbers and several cases, while the true decision stays there. The value must be a constant that a person writes: a
/// power of ten or of two, or 2 or 5 times a power of ten. `similar` are other cases with the finding.
Tested relative_tolerance_of(Trials& trials, std::span<const Trial> similar);

}  // namespace nearmiss
