/// The time and place at which a moving point meets a triangle.
#pragma once

#include <collide/detail/casts.hpp>
#include <collide/point_triangle_signed_distance.hpp>

namespace collide {

/// The first contact of `point`, moving by `velocity` per unit of time, with `triangle`. A triangle has two sides; it
/// may be a segment or a point.
///
/// An overlap at the start is a contact at time 0. A touch at the start is one too, unless the point moves away.
/// Without a contact the answer is a miss.
///
/// 1. location is a point of `triangle` that the point touches at that time; of shapes that overlap at the start, one
/// that is
///    deepest
/// 2. normal is a unit vector from `triangle` to `point` that no point of either is beyond, as for the signed distance
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source:
/// detail/casts.hpp.
COLLIDE_CAST(512, moving_point_triangle_two_sided, point_triangle_signed_distance, Vec3, point, Triangle, triangle)

}  // namespace collide
