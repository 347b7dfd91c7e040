/// The time and place at which a moving sphere meets a segment.
#pragma once

#include <collide/detail/casts.hpp>
#include <collide/sphere_segment_signed_distance.hpp>

namespace collide {

/// The first contact of `sphere`, moving by `velocity` per unit of time, with `segment`. A radius of 0 is allowed. A
/// segment may be a point.
///
/// An overlap at the start is a contact at time 0. A touch at the start is one too, unless the sphere moves away.
/// Without a contact the answer is a miss.
///
/// 1. location is a point of `segment` that the sphere touches at that time; of shapes that overlap at the start, one
/// that is
///    deepest
/// 2. normal is a unit vector from `segment` to `sphere` that no point of either is beyond, as for the signed distance
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source:
/// detail/casts.hpp.
COLLIDE_CAST(256, moving_sphere_segment, sphere_segment_signed_distance, Sphere, sphere, Segment, segment)

}  // namespace collide
