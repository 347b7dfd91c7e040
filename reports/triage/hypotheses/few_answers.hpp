/// Tests whether the numbers of an answer are a few of many.
#pragma once

#include "reports/triage/hypotheses/asked_cases.hpp"

namespace nearmiss {

/// One operand is moved by different small distances, so that the exact numbers differ, and the given ones are few: the
/// subject looks at places in steps, or halves an interval a fixed number of times.
Tested few_answers_of(AskedCases& asked);

}  // namespace nearmiss
