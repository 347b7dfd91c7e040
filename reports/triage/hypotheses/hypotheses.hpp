/// The tests of causes, each of which asks changed cases. cause_of.cpp has their order.
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

/// Overflow or underflow, from the exceptions that were raised at each scale.
Tested number_range_of(AskedCases& asked);

/// The first region of regions_of() in which nearly all answers are wrong, or in which alone some are.
Tested unsupported_of(AskedCases& asked);

/// Of the readings that explain the case, nearly all others with the finding, and generated ones: the one that makes
/// the most answers right.
Tested convention_of(AskedCases& asked);

/// The error of the worst member, over a length of the case, is one value that a person writes, in nearly all cases
/// with the finding: the subject enlarges, or shortens, something by a share of it.
Tested error_share_of(AskedCases& asked);
/// The errors are small shares of the numbers in all cases with the finding, generated ones included, at every scale,
/// in every rounding mode and for nearly all cases nearby. The share is unknown. Names nothing for motions, whose steps
/// have small errors too.
Tested small_errors_of(AskedCases& asked);

/// One operand is moved by different small distances, so that the exact numbers differ, and the given ones are few: the
/// subject looks at places in steps, or halves an interval a fixed number of times.
Tested few_answers_of(AskedCases& asked);

/// The given times of contact are few, while the exact ones differ.
Tested times_of_steps_of(AskedCases& asked);
/// The error of the time falls and jumps back by one amount, at every scale, while the start moves along the motion.
Tested errors_of_steps_of(AskedCases& asked);
/// The answer depends on where the same motion begins.
Tested starts_of_motion_of(AskedCases& asked);
/// Contacts are missed where the motion grazes, below an angle that is no tolerance, and found elsewhere.
Tested grazing_contacts_of(AskedCases& asked);

/// Nothing that changes arithmetic alone changes the finding.
Tested logic_of(AskedCases& asked);

}  // namespace nearmiss
