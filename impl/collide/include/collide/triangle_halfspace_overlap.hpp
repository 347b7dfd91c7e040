/// Whether a triangle and a half-space overlap.
#pragma once

#include <collide/detail/half_spaces.hpp>

namespace collide {

/// Whether the closed triangle and the closed half-space meet. Touching is an overlap. Vertices on one line are
/// allowed.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/half_spaces.hpp.
COLLIDE_OVERLAP_WITH_HALF_SPACE(32, triangle_halfspace_overlap, Triangle, triangle, HalfSpace, halfspace)

}  // namespace collide
