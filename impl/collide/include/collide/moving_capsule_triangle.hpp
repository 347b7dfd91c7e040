/// The time and place at which a moving capsule meets a triangle.
#pragma once

#include <collide/capsule_triangle_signed_distance.hpp>
#include <collide/detail/casts.hpp>

namespace collide {

/// The first contact of `capsule`, moving by `velocity` per unit of time, with `triangle`. A radius of 0 is allowed. A
/// capsule whose ends are equal is a sphere. A triangle has two sides; it may be a segment or a point.
///
/// An overlap at the start is a contact at time 0. A touch at the start is one too, unless the capsule moves away.
/// Without a contact the answer is a miss.
///
/// 1. location is a point of `triangle` that the capsule touches at that time; of shapes that overlap at the start, one
/// that is
///    deepest
/// 2. normal is a unit vector from `triangle` to `capsule` that no point of either is beyond, as for the signed
/// distance
///
/// Units: lengths; velocity is length per unit of time. Never fails. Non-finite input: a miss. Source:
/// detail/casts.hpp.
COLLIDE_CAST(512, moving_capsule_triangle, capsule_triangle_signed_distance, Capsule, capsule, Triangle, triangle)

}  // namespace collide
