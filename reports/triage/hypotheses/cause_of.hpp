/// Finds the cause of a finding.
#pragma once

#include "reports/findings/workers.hpp"
#include "reports/triage/causes/cause.hpp"

namespace nearmiss {

/// Tests hypotheses, the most specific first, and names the first whose test passed. The report must have a bad finding
/// (is_bad). The result is the same in every run, unless a limit of time ends the search.
Cause cause_of(const Report& report, const Subject& subject, const CauseLimits& limits, Workers& workers);

}  // namespace nearmiss
