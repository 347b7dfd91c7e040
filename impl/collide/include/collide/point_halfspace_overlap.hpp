/// Whether a point and a half-space overlap.
#pragma once

#include <collide/detail/half_spaces.hpp>

namespace collide {

/// Whether the point is in the closed half-space. Touching is an overlap.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/half_spaces.hpp.
COLLIDE_OVERLAP_WITH_HALF_SPACE(32, point_halfspace_overlap, Vec3, point, HalfSpace, halfspace)

}  // namespace collide
