/// Moves one number of a case until the subject's answer jumps, though the true decision stays.
#pragma once

#include <span>
#include <vector>

#include "reports/triage/trials/trials.hpp"

namespace nearmiss {

/// A place at which the subject's answer jumps from the finding to a right answer. The cases differ in one number.
struct Crossing {
  Case start;              ///< with the finding; the move began here
  std::size_t number = 0;  ///< the moved number
  Case at_wrong;           ///< with the finding, as near to `at_right` as bisection led
  Answer wrong;            ///< the answer to `at_wrong`
  Trial at_right;
};

/// At most two crossings for each number of the case, one in each direction. None for flags and indices, where every
/// move keeps the finding, where the exact decision is another beyond, and where the answer does not jump: where the
/// error only falls below what is proved. `wrong` has the finding. Moves these numbers alone, or all of them where none
/// are named.
std::vector<Crossing> crossings_of(Trials& trials, const Case& wrong, std::span<const std::size_t> numbers);

}  // namespace nearmiss
