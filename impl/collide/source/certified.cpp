/// The counts of the tier `Certified`.
#include <collide/certified.hpp>

#include "stages.hpp"

namespace collide {

constinit thread_local StageCounts detail::stage_counts;

StageCounts& Certified::counts() { return detail::stage_counts; }

}  // namespace collide
