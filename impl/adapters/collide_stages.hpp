/// The tally of the stages of the tier Certified, for its hosts.
#pragma once

#include <collide/certified.hpp>

#include "impl/subject/stages.hpp"

namespace nearmiss::adapters {

/// The tier counts the answers of its stages itself; this reads the counts of the thread.
inline StageTally collide_stages() {
  const collide::StageCounts& counts = collide::Certified::counts();
  return {counts.filter, counts.extended, counts.exact, counts.invalid};
}

}  // namespace nearmiss::adapters
