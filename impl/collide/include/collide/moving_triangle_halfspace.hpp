/// The time and place at which a moving triangle meets a half-space.
#pragma once

#include <collide/detail/casts_to_half_spaces.hpp>

namespace collide {

/// The first contact of `triangle`, moving by `velocity` per unit of time, with `halfspace`.
///
/// An overlap at the start is a contact at time 0. A touch at the start is one too, unless the triangle moves away. A
/// triangle in front that does not approach is a miss.
///
/// 1. location is the point of the plane below the lowest point of `triangle` at that time; where several points are
/// lowest, the point below any of them
/// 2. normal == halfspace.normal / |halfspace.normal|
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source:
/// detail/casts_to_half_spaces.hpp.
COLLIDE_CAST_AGAINST_HALF_SPACE(32, moving_triangle_halfspace, Triangle, triangle)

}  // namespace collide
