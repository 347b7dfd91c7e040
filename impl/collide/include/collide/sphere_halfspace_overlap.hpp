/// Whether a sphere and a half-space overlap.
#pragma once

#include <collide/detail/half_spaces.hpp>

namespace collide {

/// Whether the closed ball and the closed half-space meet. Touching is an overlap. A radius of 0 is allowed.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/half_spaces.hpp.
COLLIDE_OVERLAP_WITH_HALF_SPACE(32, sphere_halfspace_overlap, Sphere, sphere, HalfSpace, halfspace)

}  // namespace collide
