/// Tests whether the errors of an answer are one share of a length, or of 1, in all cases with the finding.
#pragma once

#include "reports/triage/hypotheses/asked_cases.hpp"

namespace nearmiss {

/// The error of the worst member, over a length of the case, is one value that a person writes, in nearly all cases
/// with the finding: the subject enlarges, or shortens, something by a share of it.
Tested error_share_of(AskedCases& asked);
/// The errors are small shares of the numbers in all cases with the finding, generated ones included, at every scale,
/// in every rounding mode and for nearly all cases nearby. The share is unknown. Names nothing for motions, whose steps
/// have small errors too.
Tested small_errors_of(AskedCases& asked);

}  // namespace nearmiss
