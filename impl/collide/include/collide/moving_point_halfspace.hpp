/// The time and place at which a moving point meets a half-space.
#pragma once

#include <collide/detail/casts_to_half_spaces.hpp>

namespace collide {

/// The first contact of `point`, moving by `velocity` per unit of time, with `halfspace`.
///
/// An overlap at the start is a contact at time 0. A touch at the start is one too, unless the point moves away. A
/// point in front that does not approach is a miss.
///
/// 1. location is the point of the plane below the lowest point of `point` at that time
/// 2. normal == halfspace.normal / |halfspace.normal|
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source:
/// detail/casts_to_half_spaces.hpp.
COLLIDE_CAST_AGAINST_HALF_SPACE(32, moving_point_halfspace, Vec3, point)

}  // namespace collide
