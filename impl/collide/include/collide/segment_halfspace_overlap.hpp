/// Whether a segment and a half-space overlap.
#pragma once

#include <collide/detail/half_spaces.hpp>

namespace collide {

/// Whether the closed segment and the closed half-space meet. Touching is an overlap. Equal ends are allowed.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/half_spaces.hpp.
COLLIDE_OVERLAP_WITH_HALF_SPACE(32, segment_halfspace_overlap, Segment, segment, HalfSpace, halfspace)

}  // namespace collide
