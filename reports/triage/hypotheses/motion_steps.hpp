/// Tests whether a finding comes from too few steps along a motion.
#pragma once

#include "reports/triage/hypotheses/asked_cases.hpp"

namespace nearmiss {

/// The given times of contact are few, while the exact ones differ.
Tested times_of_steps_of(AskedCases& asked);
/// The error of the time falls and jumps back by one amount, at every scale, while the start moves along the motion.
Tested errors_of_steps_of(AskedCases& asked);
/// The answer depends on where the same motion begins.
Tested starts_of_motion_of(AskedCases& asked);
/// Contacts are missed where the motion grazes, below an angle that is no tolerance, and found elsewhere.
Tested grazing_contacts_of(AskedCases& asked);

}  // namespace nearmiss
