/// The signed distance of a segment and a half-space, and the points that have it.
#pragma once

#include <collide/detail/half_spaces.hpp>

namespace collide {

/// The distance of the closed shapes, negative where they overlap, with a normal and two points. Equal ends are
/// allowed.
///
/// 1. point2 - point1 = distance * normal; the normal is a unit vector opposite to that of `halfspace`
/// 2. no point of `segment` is further along the normal than point1; point2 is on the plane
///
/// Units: lengths; the normal has none. Never fails. Non-finite input: unspecified numbers. Source:
/// detail/half_spaces.hpp.
COLLIDE_SIGNED_DISTANCE_TO_HALF_SPACE(32, segment_halfspace_signed_distance, Segment, segment, HalfSpace, halfspace)

}  // namespace collide
