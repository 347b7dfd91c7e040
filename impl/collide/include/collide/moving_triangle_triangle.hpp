/// The time and place at which a moving triangle meets another one.
#pragma once

#include <collide/detail/casts.hpp>
#include <collide/triangle_triangle_signed_distance.hpp>

namespace collide {

/// The first contact of `triangle`, moving by `velocity` per unit of time, with `fixed`. A triangle has two sides; it
/// may be a segment or a point.
///
/// An overlap at the start is a contact at time 0. A touch at the start is one too, unless the triangle moves away.
/// Without a contact the answer is a miss.
///
/// 1. location is a point of `fixed` that the triangle touches at that time; of shapes that overlap at the start, one
/// that is
///    deepest
/// 2. normal is a unit vector from `fixed` to `triangle` that no point of either is beyond, as for the signed distance
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source:
/// detail/casts.hpp.
COLLIDE_CAST(512, moving_triangle_triangle, triangle_triangle_signed_distance, Triangle, triangle, Triangle, fixed)

}  // namespace collide
