/// Whether a segment and a capsule overlap.
#pragma once

#include <collide/detail/overlaps.hpp>

namespace collide {

/// Whether the segment and the closed capsule meet. Touching is an overlap. A radius of 0 is allowed.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/overlaps.hpp.
COLLIDE_OVERLAP(segment_capsule_overlap, Segment, segment, Capsule, capsule)

}  // namespace collide
