/// Whether a capsule contains a point.
#pragma once

#include <collide/detail/overlaps_of_axes.hpp>

namespace collide {

/// Whether the closed capsule contains `point`. Its surface belongs to it. A radius of 0 is allowed.
///
/// Units: lengths. Never fails. Non-finite input: no. Source: detail/overlaps_of_axes.hpp.
COLLIDE_OVERLAP_OF_AXES(point_capsule_overlap, Vec3, point, Capsule, capsule)

}  // namespace collide
