/// Makes other cases near the border of the exact decision.
#pragma once

#include <span>
#include <vector>

#include "reports/triage/trials/trials.hpp"

namespace nearmiss {

/// At most `most` of the given trials, each with its first operand moved along an axis to where the exact decision
/// changes, and then away from there, so that the finding of `trials` is there too. Each is as far from the border as
/// the finding allows, to a factor of 64. None where the query decides nothing.
std::vector<Trial> cases_at_touches(Trials& trials, std::span<const Trial> from, std::size_t most);

/// Whether a decision is wrong on the other side of the border too: that of the given trials, moved as above, to the
/// other decision than the exact one of `trials`. A tolerance errs to one side, rounding errs to both.
bool errs_beyond_touches(Trials& trials, std::span<const Trial> from);

}  // namespace nearmiss
